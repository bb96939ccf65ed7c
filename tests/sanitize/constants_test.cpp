// What compilers fold is found at its line, whatever becomes of the value.
#include <ostream>

#include <gtest/gtest.h>

#include "sanitize_support.hpp"

namespace gobo {
namespace {

struct Row {
    std::string name;
    std::string globals;    ///< in line 6
    std::string statement;  ///< in line 8; sets `result`
    Lines found;            ///< none of a harmless one
};

std::ostream& operator<<(std::ostream& stream, const Row& row) {
    return stream << row.name;
}

const Row kRows[] = {
    {"literal_division", "", "result = clamp(1.0 / 0.0, 0.0, 1.0);", {"8: division by zero"}},
    {"zero_by_zero", "", "result = max(0.0 / 0.0, 1.0);", {"8: division by zero"}},
    {"near_is_far",
     "const float near = 5.0; const float far = 5.0; const float scale = 1.0 / (far - near);",
     "result = clamp((far - x) * scale, 0.0, 1.0);",
     {"6: division by zero"}},
    {"macros", "", "result = 1.0 / (FAR - NEAR);", {"8: division by zero"}},
    {"of_integers", "", "result = float(7 / 0);", {"8: integer division by zero"}},
    {"remainder", "", "result = float(-7 % 4);", {"8: integer remainder of a negative number"}},
    {"smallest_by_minus_one",
     "",
     "result = float((-2147483647 - 1) / -1);",
     {"8: integer division overflows"}},
    {"shift", "", "result = float(1 << 40);", {"8: shift by more than 31 bits"}},
    {"to_int", "", "result = float(int(1e20));", {"8: conversion to int out of range"}},
    {"to_uint", "", "result = float(uint(-1.5));", {"8: conversion to uint out of range"}},
    {"logarithm", "", "result = clamp(log(0.0), 0.0, 1.0);", {"8: log() of a number not above 0"}},
    {"root", "const float k = 2.0;", "result = sqrt(1.0 - k) + x;", {"8: sqrt() of a negative number"}},
    {"power", "", "result = pow(-2.0, 3.0);", {"8: pow() of a negative number"}},
    {"arc_cosine",
     "const vec2 v = vec2(0.0, 1.5);",
     "result = acos(v.y);",
     {"8: acos() of a number beyond [-1, 1]"}},
    {"overflow",
     "const float big = 1e30;",
     "result = min(big * big, x);",
     {"8: an infinity made from finite numbers"}},
    {"by_component", "const vec3 size = vec3(1, 0, 2);", "result = (1.0 / size).x;", {"8: division by zero"}},
    {"of_arrays",
     "const float steps[3] = float[3](1.0, 0.0, 2.0);",
     "result = 1.0 / steps[1];",
     {"8: division by zero"}},
    {"zero_vector",
     "const vec3 up = vec3(0.0);",
     "result = normalize(up).x;",
     {"8: normalize() of a zero vector"}},
    {"smooth_step",
     "const float edge = 0.5;",
     "result = smoothstep(edge, edge, 0.5);",
     {"8: smoothstep() with equal edges"}},
    {"in_a_choice", "", "result = x > 0.0 ? 1.0 / 0.0 : 0.0;", {"8: division by zero"}},
    {"of_a_called_function", "float f() { return 1.0 / 0.0; }", "result = f();", {"6: division by zero"}},
    {"too_small_a_difference", "", "result = 1.0 / (5.0000001 - 5.0);", {"8: division by zero"}},
    // What must stay silent.
    {"harmless_guarded",
     "const float near = 5.0; const float far = 5.0;",
     "result = far != near ? 1.0 / (far - near) : 0.0;",
     {}},
    {"harmless_if", "const int count = 0;", "if (count > 0) result = 1.0 / float(count);", {}},
    {"harmless_else",
     "const int count = 0;",
     "if (count == 0) result = 1.0; else result = float(8 / count);",
     {}},
    {"harmless_and", "const int count = 0;", "result = count != 0 && 8 / count > 1 ? 1.0 : 0.0;", {}},
    {"harmless_macro", "", "result = LEVELS > 0 ? 1.0 / float(LEVELS) : 1.0;", {}},
    {"harmless_shadowed", "const float d = 0.0;", "{ float d = x * x + 1.0; result = 1.0 / d; }", {}},
    {"harmless_parameter",
     "const float d = 0.0; float f(float d) { return 1.0 / d; }",
     "result = f(2.0 + x * x);",
     {}},
    {"harmless_uncalled", "float f() { return 1.0 / 0.0; }", "result = x;", {}},
    {"harmless_constants",
     "const float pi = 3.14159; const vec3 luma = vec3(0.2, 0.7, 0.1); const mat2 m = mat2(1.0);",
     "result = dot(luma, vec3(1.0 / pi)) + float(31 >> 2) + mod(-5.0, 3.0) + m[1][1] + 1e-3 + float(0x10);",
     {}},
};

std::string shader_with(const Row& row) {
    return "#version 450\n"
           "#define FAR 2.0\n"
           "#define NEAR 2.0\n"
           "#define LEVELS 0\n"
           "in float x; out vec4 color;\n" +
           row.globals + "\nvoid main() { float result = 0.0;\n" + row.statement +
           "\n    color = vec4(result + x);\n}\n";
}

class Folded : public testing::TestWithParam<Row> {};

TEST_P(Folded, IsFoundAtItsLine) {
    const sanitize::SanitizeReport report = sanitized_text("folded.frag", shader_with(GetParam()), {});
    EXPECT_EQ(found_lines(report), GetParam().found);
}

INSTANTIATE_TEST_SUITE_P(Rows, Folded, testing::ValuesIn(kRows), row_name);

struct TextRow {
    std::string name;
    std::string statement;
    std::string text;
};

std::ostream& operator<<(std::ostream& stream, const TextRow& row) {
    return stream << row.name;
}

class FoldedText : public testing::TestWithParam<TextRow> {};

/// Integers have all their digits, floats as many as tell them apart.
TEST_P(FoldedText, SaysWithWhatItHappens) {
    const Row row{"", "", GetParam().statement, {}};
    const sanitize::SanitizeReport report = sanitized_text("folded.frag", shader_with(row), {});
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings.front().finding.operation, GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, FoldedText,
    testing::Values(TextRow{"least_int", "result = float((-2147483647 - 1) / -1);",
                            "SDiv -2147483648, -1 -> -2147483648"},
                    TextRow{"large_int", "result = float(2147483647 / 0);", "SDiv 2147483647, 0 -> 0"},
                    TextRow{"large_uint", "result = float(4294967295u % 0u);", "UMod 4294967295, 0 -> 0"},
                    TextRow{"float", "result = 16777216.0 / 0.0;", "FDiv 16777216, 0 -> inf"}),
    row_name);

}  // namespace
}  // namespace gobo
