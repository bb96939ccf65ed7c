// Each trap by a statement that has it and one like it that has not, on inputs in [-100, 100].
#include <ostream>

#include <gtest/gtest.h>

#include "sanitize_support.hpp"

namespace gobo {
namespace {

struct Row {
    std::string name;
    std::string trapping;  ///< a statement that sets `result`
    std::string message;
    std::string harmless;  ///< another one; empty where every use of the operation is a trap
};

std::ostream& operator<<(std::ostream& stream, const Row& row) {
    return stream << row.name;
}

const Row kRows[] = {
    {"division", "result = a / b;", "division by zero", "result = a / (abs(b) + 1.0);"},
    {"mod", "result = mod(a, b);", "mod() by zero", "result = mod(a, 3.0);"},
    {"integer_division", "result = float(i / j);", "integer division by zero",
     "result = float(i / (j == 0 ? 1 : j));"},
    {"integer_division_overflow", "result = float((i < 0 ? -2147483648 : i) / (j < 0 ? -1 : 1));",
     "integer division overflows", "result = float((i < 0 ? -2147483647 : i) / (j < 0 ? -1 : 1));"},
    {"integer_remainder", "result = float(abs(i) % abs(j));", "integer remainder by zero",
     "result = float(abs(i) % (abs(j) + 1));"},
    {"remainder_of_negative", "result = float(i % 7);", "integer remainder of a negative number",
     "result = float(abs(i) % 7);"},
    {"unsigned_division", "result = float(uint(abs(i)) / uint(abs(j)));", "integer division by zero",
     "result = float(uint(abs(i)) / (uint(abs(j)) + 1u));"},
    {"shift", "result = float(1 << abs(i));", "shift by more than 31 bits", "result = float(1 << (i & 31));"},
    {"shift_right", "result = float(i >> j);", "shift by more than 31 bits",
     "result = float(i >> (j & 31));"},
    {"bits_taken", "result = float(bitfieldExtract(i, 8, abs(j)));", "bit field beyond 32 bits",
     "result = float(bitfieldExtract(i, 8, j & 7));"},
    {"bits_put", "result = float(bitfieldInsert(i, j, abs(j), 8));", "bit field beyond 32 bits",
     "result = float(bitfieldInsert(i, j, j & 7, 8));"},
    {"power_of_negative", "result = pow(a, 1.5);", "pow() of a negative number",
     "result = pow(abs(a), 1.5);"},
    {"power_of_zero", "result = pow(min(abs(a), 1.0), 0.0 * b);", "pow(0, y) with y not above 0",
     "result = pow(min(abs(a), 1.0), abs(b) + 0.1);"},
    {"overflowing_power", "result = pow(abs(a) + 1.0, abs(b));", "an infinity made from finite numbers",
     "result = pow(abs(a) + 1.0, abs(b) * 0.1);"},
    {"split_number", "int e; result = sqrt(frexp(a, e)) + float(e);", "sqrt() of a negative number",
     "int e; result = frexp(abs(a) + 0.01, e) + float(e);"},
    {"square_root", "result = sqrt(a);", "sqrt() of a negative number", "result = sqrt(abs(a));"},
    {"inverse_root", "result = inversesqrt(abs(a));", "inversesqrt() of a number not above 0",
     "result = inversesqrt(abs(a) + 1.0);"},
    {"logarithm", "result = log(abs(a));", "log() of a number not above 0", "result = log(abs(a) + 1.0);"},
    {"binary_logarithm", "result = log2(abs(a));", "log2() of a number not above 0",
     "result = log2(abs(a) + 1.0);"},
    {"arc_cosine", "result = acos(a);", "acos() of a number beyond [-1, 1]",
     "result = acos(clamp(a, -1.0, 1.0));"},
    {"arc_sine", "result = asin(a);", "asin() of a number beyond [-1, 1]",
     "result = asin(clamp(a, -1.0, 1.0));"},
    {"arc_tangent", "result = atan(a, b);", "atan(0, 0)", "result = atan(a, abs(b) + 1.0);"},
    {"hyperbolic_arc_cosine", "result = acosh(abs(a));", "acosh() of a number below 1",
     "result = acosh(abs(a) + 1.0);"},
    {"hyperbolic_arc_tangent", "result = atanh(clamp(a, -1.0, 1.0));",
     "atanh() of a number not within (-1, 1)", "result = atanh(a * 0.001);"},
    {"exponential", "result = exp(a);", "an infinity made from finite numbers",
     "result = exp(min(a, 80.0));"},
    {"smooth_step_equal", "result = smoothstep(abs(a), abs(a) + abs(b), 1.0);",
     "smoothstep() with equal edges", "result = smoothstep(abs(a), abs(a) + abs(b) + 1.0, 1.0);"},
    {"smooth_step_swapped", "result = smoothstep(1000.0, a, b);",
     "smoothstep() with its first edge above its second", "result = smoothstep(-1000.0, a, b);"},
    {"clamp_swapped", "result = clamp(1.0, a, 99.0);", "clamp() with its minimum above its maximum",
     "result = clamp(1.0, a, 100.0);"},
    {"normalize_zero", "result = normalize(v).x;", "normalize() of a zero vector",
     "result = normalize(vec3(v.xy, 1.0)).x;"},
    {"normalize_small", "result = normalize(vec3(1e-20, 0.0, abs(a) * 1e-30)).x;",
     "normalize() underflows: the square of the length is too small",
     "result = normalize(vec3(1e-10, 0.0, abs(a) * 1e-30)).x;"},
    {"normalize_large", "result = normalize(vec3(1e20, v.xy)).x;",
     "normalize() overflows: the square of the length is too large",
     "result = normalize(vec3(1e15, v.xy)).x;"},
    {"length_small", "result = length(vec2(1e-20, 0.0) * (abs(a) + 1.0));",
     "length() underflows: its square is too small", "result = length(v);"},
    {"length_large", "result = length(vec2(1e20, a));", "length() overflows: its square is too large",
     "result = length(vec2(1e15, a));"},
    {"distance_small", "result = distance(vec2(1e-20, a * 0.0), vec2(0.0));",
     "distance() underflows: its square is too small", "result = distance(v, w);"},
    {"distance_large", "result = distance(vec2(1e20, a), vec2(0.0));",
     "distance() overflows: its square is too large", "result = distance(vec2(1e15, a), vec2(0.0));"},
    {"inverse", "result = inverse(mat2(a, 0.0, 0.0, b))[0][0];", "inverse() of a singular matrix",
     "result = inverse(mat2(abs(a) + 1.0, 0.0, 0.0, abs(b) + 1.0))[0][0];"},
    {"to_int", "result = float(int(a * 1e8));", "conversion to int out of range",
     "result = float(int(a * 1e7));"},
    {"to_uint", "result = float(uint(a));", "conversion to uint out of range",
     "result = float(uint(abs(a)));"},
    {"index", "result = table[i];", "array index out of bounds", "result = table[i & 3];"},
    {"component", "result = v[i];", "array index out of bounds", "result = v[clamp(i, 0, 2)];"},
    {"matrix_column", "result = m[i].x;", "array index out of bounds", "result = m[clamp(i, 0, 2)].x;"},
    {"sum", "result = 1e38 * a - 1e38 * b;", "an infinity made from finite numbers",
     "result = 1e35 * a - 1e35 * b;"},
    {"dot_product", "result = dot(1e18 * v, 1e18 * v);", "an infinity made from finite numbers",
     "result = dot(1e16 * v, 1e16 * v);"},
    {"unwritten", "float unset; if (a > 0.0) unset = b; result = unset + 1.0;",
     "a value is read before it is written",
     "float unset = 0.0; if (a > 0.0) unset = b; result = unset + 1.0;"},
    {"unwritten_component", "vec2 half_set; half_set.x = a; result = dot(half_set, vec2(1.0));",
     "a value is read before it is written",
     "vec2 both; both.x = a; both.y = b; result = dot(both, vec2(1.0));"},
};

/// The statement stands in line 14.
std::string shader_with(const std::string& statement) {
    return "#version 450\n"
           "layout(location = 0) in float a;\n"
           "layout(location = 1) in float b;\n"
           "layout(location = 2) in vec3 v;\n"
           "layout(location = 3) in vec3 w;\n"
           "layout(location = 4) flat in int i;\n"
           "layout(location = 5) flat in int j;\n"
           "uniform mat3 m;\n"
           "uniform float table[4];\n"
           "layout(location = 0) out vec4 color;\n"
           "\n"
           "void main() {\n"
           "    float result = 0.0;\n"
           "    " +
           statement +
           "\n"
           "    color = vec4(result);\n"
           "}\n";
}

class Trap : public testing::TestWithParam<Row> {};

TEST_P(Trap, IsFlaggedAtItsLine) {
    const std::string text = shader_with(GetParam().trapping);
    const sanitize::SanitizeReport report = sanitized_text("trap.frag", text, {});
    EXPECT_EQ(found_lines(report), Lines{"14: " + GetParam().message});
    EXPECT_EQ(not_replayed("trap.frag", text, report), Lines{});
}

TEST_P(Trap, IsNotSeenWhereItCannotHappen) {
    const sanitize::SanitizeReport report = sanitized_text("trap.frag", shader_with(GetParam().harmless), {});
    EXPECT_EQ(found_lines(report), Lines{});
}

INSTANTIATE_TEST_SUITE_P(Rows, Trap, testing::ValuesIn(kRows), row_name);

/// However often a loop runs into it.
TEST(TrapInALoop, CountsEachPointOnce) {
    for (const std::string trapping : {"table[k - 9]", "1.0 / (a - a)", "1.0 / (a - a) + 1.0 / (b - b)"}) {
        const std::string text = shader_with("for (int k = 0; k < 8; ++k) result += " + trapping + ";");
        const sanitize::SanitizeReport report = sanitized_text("trap.frag", text, {.points = 64});
        ASSERT_FALSE(report.findings.empty()) << trapping;
        EXPECT_EQ(report.findings.front().finding.points, 64U) << trapping;
    }
}

/// What a NaN from an earlier trap reaches is no trap of its own: it is told beneath that.
TEST(TrapOfANaN, IsFoldedBeneathItsCause) {
    for (const std::string hidden : {"min", "max"}) {
        const std::string text =
            shader_with("float ratio = a / b;\n    result = " + hidden + "(ratio, 1.0);");
        const sanitize::SanitizeReport report = sanitized_text("trap.frag", text, {});
        EXPECT_EQ(found_lines(report), Lines{"14: division by zero"});
        EXPECT_EQ(consequences(report), Lines{"15: " + hidden + "() fed a NaN"});
    }
}

/// A NaN does not hide what is wrong at its line at other points.
TEST(TrapOfANaN, LeavesTheTrapsOfItsLine) {
    const std::string text = shader_with("vec3 n = normalize(v);\n    result = normalize(n + w).x;");
    EXPECT_EQ(found_lines(sanitized_text("trap.frag", text, {})),
              (Lines{"14: normalize() of a zero vector", "15: normalize() of a zero vector"}));
}

/// Two directions whose half vector lies along an axis: a component comes out a rounding beyond 1.
TEST(TrapOfAReflection, IsFound) {
    const auto of_length = [](const char* name, double low, double high) {
        Domain domain;
        domain.name = name;
        domain.low = low;
        domain.high = high;
        domain.of_length = true;
        return domain;
    };
    const std::vector<Domain> domains = {of_length("v", 0.1, 10), of_length("w", 0.9, 1.1)};
    const std::string reflected = "vec3 r = reflect(-normalize(v), normalize(w)); ";
    const auto lines = [&](const std::string& result) {
        return found_lines(sanitized_text("trap.frag", shader_with(reflected + result), {}, domains));
    };
    EXPECT_EQ(lines("result = acos(r.y);"), Lines{"14: acos() of a number beyond [-1, 1]"});
    EXPECT_EQ(lines("result = sqrt(1.0 - r.z * r.z);"), Lines{"14: sqrt() of a negative number"});
    EXPECT_EQ(lines("result = acos(clamp(r.y, -1.0, 1.0));"), Lines{});
}

}  // namespace
}  // namespace gobo
