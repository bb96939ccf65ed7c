// What is proven of shaders whose answers are known, and that nothing is proven which an evaluation
// contradicts.
#include "lab/prove/prove.hpp"

#include <map>

#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "compose/search_path.hpp"
#include "core/file_system.hpp"
#include "lab/prove/rules.hpp"
#include "sanitize_support.hpp"

namespace gobo {
namespace {

using prove::Status;

prove::ProveReport proven(const std::string& path, const FileSystem& files,
                          const prove::ProveOptions& options, const std::vector<Domain>& domains = {}) {
    SearchPath search;
    Result<Family> family = family_of_files({path}, files, search);
    EXPECT_TRUE(family) << path;
    family->domains.insert(family->domains.begin(), domains.begin(), domains.end());
    const Result<Composition> composition = compose(*family, {Key{}}, search, Dialect::own);
    EXPECT_TRUE(composition) << path;
    ValidateOptions validate_options;
    validate_options.keep_spirv = true;
    validate_options.debug_information = true;
    const Validated validated = validate(*family, *composition, validate_options);
    for (const Diagnostic& error : validated.diagnostics) {
        if (error.severity == Severity::error) ADD_FAILURE() << to_text(error);
    }
    prove::ProveReport report = prove::prove(*family, *composition, validated, options);
    return report;
}

/// The same of a fragment stage's text, that writes `color` and reads `a`.
prove::ProveReport proven_text(const std::string& statements) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"known.frag",
         "#version 450\nlayout(location = 0) in float a;\nlayout(location = 0) out float color;\n"
         "float total(float x) { return x - 2.0; }\nvoid main() {\n" +
             statements + "\n}\n"}});
    return proven("known.frag", files, {});
}

/// The worst of a rule over a file.
std::map<std::string, Status> by_rule(const prove::ProveReport& report) {
    for (const Diagnostic& error : report.diagnostics) ADD_FAILURE() << to_text(error);
    std::map<std::string, Status> all;
    for (const prove::SourceOperation& operation : report.operations)
        for (const prove::ProvenRule& rule : operation.rules)
            all[rule.message] = std::max(all[rule.message], rule.status);
    return all;
}

std::string word(Status status) {
    return status == Status::impossible ? "impossible"
           : status == Status::possible ? "possible"
                                        : "undecided";
}

TEST(Proofs, ExistForEveryRuleOfTheSanitizer) {
    // A determinant is told from 0 by nothing that is known here.
    EXPECT_EQ(prove::rules_without_proof(), std::vector<std::string_view>{"inverse() of a singular matrix"});
}

struct Row {
    std::string name;
    std::string statements;  ///< that set `result`
    std::string rule;
    Status status;
};

constexpr Status kImpossible = Status::impossible;
constexpr Status kPossible = Status::possible;

const Row kRows[] = {
    {"division", "result = a / b;", "division by zero", kPossible},
    {"division_by_a_square_and_one", "result = a / (b * b + 1.0);", "division by zero", kImpossible},
    {"division_behind_a_comparison", "if (b != 0.0) result = a / b;", "division by zero", kImpossible},
    {"division_behind_another_comparison", "if (a != 0.0) result = a / b;", "division by zero", kPossible},
    {"division_behind_a_size", "if (abs(b) > 1e-3 && a > 0.0) result = a / b;", "division by zero",
     kImpossible},
    {"division_by_a_difference", "if (a < b) result = 1.0 / (b - a);", "division by zero", kImpossible},
    {"division_by_a_difference_of_a_chain", "if (a < b) { if (b < v.x) result = 1.0 / (v.x - a); }",
     "division by zero", kImpossible},
    {"division_by_a_difference_the_wrong_way", "if (a <= b) result = 1.0 / (b - a);", "division by zero",
     kPossible},
    {"division_in_a_loop", "for (int k = 1; k < 9; ++k) result += a / float(k);", "division by zero",
     kImpossible},
    {"division_in_a_loop_from_0", "for (int k = 0; k < 9; ++k) result += a / float(k - 4);",
     "division by zero", kPossible},
    {"division_after_a_loop_that_an_input_bounds",
     "int k = 1; while (k < abs(i)) k += 7; result = a / float(k);", "division by zero", kImpossible},
    {"root_of_a_square", "result = sqrt(dot(v, v));", "sqrt() of a negative number", kImpossible},
    {"root_of_one_less_a_square", "result = sqrt(1.0 - a * a);", "sqrt() of a negative number", kPossible},
    {"root_of_one_less_a_clamped_square", "float c = clamp(a, -1.0, 1.0); result = sqrt(1.0 - c * c);",
     "sqrt() of a negative number", kImpossible},
    {"root_of_a_sine",
     "vec3 n = v * inversesqrt(max(dot(v, v), 1e-20)); result = sqrt(max(1.0 - n.x * n.x, 0.0));",
     "sqrt() of a negative number", kImpossible},
    {"arc_cosine_of_unit_vectors", "result = acos(dot(normalize(v), vec3(1.0, 0.0, 0.0)) * 0.999);",
     "acos() of a number beyond [-1, 1]", Status::undecided},
    {"power_of_a_size", "result = pow(abs(a) + 1e-3, b * 0.01);", "pow() of a negative number", kImpossible},
    {"power_of_zero", "result = pow(abs(a), 0.0);", "pow(0, y) with y not above 0", kPossible},
    {"angle_of_a_point_not_at_the_origin", "if (abs(a) + abs(b) != 0.0) result = atan(a, b);", "atan(0, 0)",
     kImpossible},
    {"angle", "result = atan(a, b);", "atan(0, 0)", kPossible},
    {"scaled_by_its_largest_component",
     "vec3 w = v / max(abs(v.x), max(abs(v.y), max(abs(v.z), 1e-30))); result = acos(w.x);",
     "acos() of a number beyond [-1, 1]", kPossible},
    {"shift_by_masked_bits", "result = float(1 << (i & 31));", "shift by more than 31 bits", kImpossible},
    {"shift", "result = float(1 << abs(i));", "shift by more than 31 bits", kPossible},
    {"index_clamped", "float all[4] = float[4](1.0, 2.0, 3.0, a); result = all[clamp(i, 0, 3)];",
     "array index out of bounds", kImpossible},
    {"index", "float all[4] = float[4](1.0, 2.0, 3.0, a); result = all[abs(i)];", "array index out of bounds",
     kPossible},
    {"overflow_of_exponential", "result = exp(a);", "an infinity made from finite numbers", kPossible},
    {"exponential_of_less", "result = exp(min(a, 80.0));", "an infinity made from finite numbers",
     kImpossible},
    {"conversion", "result = float(int(a * 1e9));", "conversion to int out of range", kPossible},
    {"conversion_within", "result = float(int(floor(a)));", "conversion to int out of range", kImpossible},
    {"edges_in_order", "result = smoothstep(a, a + 1.0, b);", "smoothstep() with equal edges",
     Status::undecided},
    {"normalize_away_from_zero", "result = normalize(vec3(v.xy, 1.0)).x;", "normalize() of a zero vector",
     kImpossible},
    {"pixel_beside_a_tile", "result = 1.0 / (gl_FragCoord.x - 7.5);", "division by zero", kPossible},
    {"pixel_beyond_the_first", "result = sqrt(1.0 - gl_FragCoord.y);", "sqrt() of a negative number",
     kPossible},
    {"pixel_is_not_negative", "result = sqrt(gl_FragCoord.x);", "sqrt() of a negative number", kImpossible},
    {"many_primitives", "result = sqrt(1e6 - float(gl_PrimitiveID));", "sqrt() of a negative number",
     Status::undecided},
    {"index_of_high_bits", "float all[15]; for (int k = 0; k < 15; ++k) all[k] = a; result = all[s >> 28];",
     "array index out of bounds", kPossible},
    {"index_of_all_high_bits",
     "float all[16]; for (int k = 0; k < 16; ++k) all[k] = a; result = all[s >> 28];",
     "array index out of bounds", kImpossible},
    {"index_by_remainder", "float all[7]; for (int k = 0; k < 7; ++k) all[k] = a; result = all[s % 7u];",
     "array index out of bounds", kImpossible},
    {"root_of_a_large_uint", "result = sqrt(3e9 - float(s));", "sqrt() of a negative number", kPossible},
    {"large_uint_as_int", "result = sqrt(float(int(s)));", "sqrt() of a negative number", kPossible},
    {"difference_of_pixels_on_either_side_of_a_condition",
     "if (clamp(a, 0.0, 1.0) < 0.5) result = sqrt(1.0 - fwidth(clamp(a, 0.0, 1.0)));",
     "sqrt() of a negative number", Status::undecided},  // its neighbours went another way
    {"constant_nan_beside_a_constant_zero", "result = max(a, sqrt(-1.0));", "max() fed a NaN",
     Status::undecided},
    {"exponent_of_a_float", "int e; result = frexp(abs(a) + 0.01, e) + float(e);",
     "a NaN made from finite numbers", kImpossible},
    {"difference_of_pixels_in_other_parts_of_the_domain", "result = sqrt(200.0 - abs(dFdx(a) * 1.25));",
     "sqrt() of a negative number", kPossible},
    {"difference_of_pixels", "result = sqrt(201.0 - abs(dFdx(a)));", "sqrt() of a negative number",
     kImpossible},
    {"normalize", "result = normalize(v).x;", "normalize() of a zero vector", kPossible},
};

class Proof : public testing::TestWithParam<Row> {};

TEST_P(Proof, IsAsKnown) {
    const Row& row = GetParam();
    const std::string text =
        "#version 450\nlayout(location = 0) in float a;\nlayout(location = 1) in float b;\nlayout(location = "
        "2) in vec3 v;\n"
        "layout(location = 3) flat in int i;\nlayout(location = 4) flat in uint s;\nlayout(location = 0) out "
        "float color;\nvoid main() {\n    "
        "float result = 0.0;\n    " +
        row.statements + "\n    color = result;\n}\n";
    prove::ProveOptions options;
    options.check = 4096;
    options.points = 2048;
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{{"known.frag", text}});
    Domain any;
    any.name = "s";
    any.high = 4294967295.0;
    const auto found = by_rule(proven("known.frag", files, options, {any}));
    ASSERT_TRUE(found.contains(row.rule));
    EXPECT_EQ(word(found.at(row.rule)), word(row.status));
}

INSTANTIATE_TEST_SUITE_P(Rows, Proof, testing::ValuesIn(kRows),
                         [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

/// What some variants compute with 16-bit floats: the limits are theirs.
struct MediumpRow {
    std::string name;
    std::string declarations;
    std::string statements;  ///< that set `result`
    Domain domain;
    std::string rule;
    Status status;
};

Domain domain_of(std::string name, double low, double high, bool of_length = false) {
    Domain domain;
    domain.name = std::move(name);
    domain.low = low;
    domain.high = high;
    domain.of_length = of_length;
    return domain;
}

const std::string kInfinite = "an infinity made from finite numbers";

const MediumpRow kMediumpRows[] = {
    {"normalize_of_long_vectors", "in mediump vec3 v;", "result = normalize(v).x;",
     domain_of("v", 500, 1000, true), "normalize() overflows: the square of the length is too large",
     kPossible},
    {"normalize_of_vectors_within_16_bits", "in mediump vec3 v;", "result = normalize(v).x;",
     domain_of("v", 100, 255, true), "normalize() overflows: the square of the length is too large",
     kImpossible},
    {"normalize_of_short_vectors", "in mediump vec3 v;", "result = normalize(v).x;",
     domain_of("v", 0.001, 0.002, true), "normalize() underflows: the square of the length is too small",
     kPossible},
    {"normalize_of_vectors_not_short", "in mediump vec3 v;", "result = normalize(v).x;",
     domain_of("v", 0.01, 1, true), "normalize() underflows: the square of the length is too small",
     kImpossible},
    {"normalize_in_highp_of_what_mediump_read", "in mediump vec3 v; in highp float k;",
     "mediump vec3 w = v; result = normalize(w * k).x;", domain_of("v", 500, 1000),
     "normalize() overflows: the square of the length is too large", kImpossible},
    {"length", "in mediump vec3 v;", "result = length(v);", domain_of("v", 500, 1000, true),
     "length() overflows: its square is too large", kPossible},
    {"length_of_a_part", "in mediump vec3 v;", "result = length(v.xy);", domain_of("v", 500, 1000, true),
     "length() overflows: its square is too large", kPossible},
    {"distance", "in mediump vec3 v;", "result = distance(v, -v);", domain_of("v", 500, 1000, true),
     "distance() overflows: its square is too large", kPossible},
    {"distance_in_highp", "in highp vec3 v;", "result = distance(v, -v);", domain_of("v", 500, 1000, true),
     "distance() overflows: its square is too large", kImpossible},
    {"uniform_beyond_16_bits", "uniform mediump vec3 v; in highp float k;",
     "mediump vec3 c = v; result = (c * k).x;", domain_of("v", 0, 1e5), kInfinite, kPossible},
    {"uniform_within_16_bits", "uniform mediump vec3 v; in highp float k;",
     "mediump vec3 c = v; result = (c * k).x;", domain_of("v", 0, 6e4), kInfinite, kImpossible},
    {"stored_in_a_mediump_variable", "in highp float k; in highp vec3 v;",
     "mediump float x = v.x;\n result = 1.0 / (2.0 + x);", domain_of("v", 1, 1e6), kInfinite, kPossible},
    {"stored_in_a_mediump_variable_within_16_bits", "in highp float k; in highp vec3 v;",
     "mediump float x = v.x;\n result = 1.0 / (2.0 + x);", domain_of("v", 1, 6e4), kInfinite, kImpossible},
    {"stored_in_an_element_of_an_array", "flat in highp int v;",
     "float x[4] = float[4](1.0, 1.0, 1.0, 1.0); x[v] = float(v) * 3e4;\n result = 1.0 / (2.0 + x[v]);",
     domain_of("v", 0, 3), kInfinite, kPossible},
    {"stored_in_an_element_within_16_bits", "flat in highp int v;",
     "float x[4] = float[4](1.0, 1.0, 1.0, 1.0); x[v] = float(v) * 2e4;\n result = 1.0 / (2.0 + x[v]);",
     domain_of("v", 0, 3), kInfinite, kImpossible},
    {"converted", "flat in mediump int v;", "result = 1.0 / (2.0 + float(v));", domain_of("v", 0, 100000),
     kInfinite, kPossible},
    {"product_of_what_may_be_infinite", "uniform mediump float v;",
     "mediump float c = min(v * 3e4, 6e4); mediump float d = sqrt(v * 3e4); result = c + d;",
     domain_of("v", 0, 2), kInfinite, kImpossible},
    {"dot", "in mediump vec3 v;", "result = dot(v, v);", domain_of("v", 0, 200), kInfinite, kPossible},
    {"cross", "in mediump vec3 v;", "result = cross(v, v.yzx).x;", domain_of("v", -1e3, 1e3), kInfinite,
     kPossible},
    {"reflect", "in mediump vec3 v;", "result = reflect(v, v).x;", domain_of("v", 0, 40), kInfinite,
     kPossible},
    {"refract", "in mediump vec3 v;", "result = refract(v, v, 0.9).x;", domain_of("v", 0, 300), kInfinite,
     kPossible},
    {"pow", "in mediump vec3 v;", "result = pow(v.x, 2.0);", domain_of("v", 1, 300), kInfinite, kPossible},
    {"exp", "in mediump vec3 v;", "result = exp(v.x);", domain_of("v", 0, 12), kInfinite, kPossible},
    {"exp_within_16_bits", "in mediump vec3 v;", "result = exp(v.x);", domain_of("v", 0, 11), kInfinite,
     kImpossible},
    {"division_by_what_may_be_flushed", "in mediump float v;", "result = 1e-2 / v;", domain_of("v", 1e-5, 1),
     "division by zero", kPossible},
    {"division_by_what_is_not_flushed", "in mediump float v;", "result = 1e-2 / v;", domain_of("v", 1e-4, 1),
     "division by zero", kImpossible},
    {"determinant", "in mediump vec3 v;", "result = determinant(mat3(v, v.yzx, v.zxy));",
     domain_of("v", 0, 50), kInfinite, kPossible},
    {"matrix_product", "in mediump vec3 v;", "result = (mat3(v, v, v) * v).x;", domain_of("v", 0, 250),
     kInfinite, kPossible},
    {"product_of_matrices", "in mediump vec3 v;", "result = (mat3(v, v, v) * mat3(v, v, v))[0].x;",
     domain_of("v", 0, 250), kInfinite, kPossible},
    {"conversion", "in mediump vec3 v;", "result = float(int(v.x));", domain_of("v", 0, 1e6),
     "conversion to int out of range", Status::undecided},  // of an infinity, which is told where it is made
};

class MediumpProof : public testing::TestWithParam<MediumpRow> {};

TEST_P(MediumpProof, IsAsKnown) {
    const MediumpRow& row = GetParam();
    const std::string text = "#version 300 es\nprecision mediump float;\n" + row.declarations +
                             "\nout highp float color;\nvoid main() {\n    float result;\n    " +
                             row.statements + "\n    color = result;\n}\n";
    prove::ProveOptions options;
    options.check = 8192;
    options.points = 8192;
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{{"known.frag", text}});
    const auto found = by_rule(proven("known.frag", files, options, {row.domain, domain_of("k", 0, 1)}));
    ASSERT_TRUE(found.contains(row.rule));
    EXPECT_EQ(word(found.at(row.rule)), word(row.status));
}

INSTANTIATE_TEST_SUITE_P(Rows, MediumpProof, testing::ValuesIn(kMediumpRows),
                         [](const testing::TestParamInfo<MediumpRow>& row) { return row.param.name; });

/// b may be infinite, which says nothing of those that are not.
TEST(MediumpProofs, HoldWhereOperandsMayBeInfinite) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"known.frag",
         "#version 300 es\nprecision mediump float;\nin float a;\nout vec4 color;\nvoid main() {\n"
         "    float b = a * a;\n    color = vec4(b + 100.0);\n}\n"}});
    std::map<int, Status> by_line;
    for (const prove::SourceOperation& operation :
         proven("known.frag", files, {}, {domain_of("a", 0, 300)}).operations)
        for (const prove::ProvenRule& rule : operation.rules)
            if (rule.message == kInfinite)
                by_line[operation.place.line] = std::max(by_line[operation.place.line], rule.status);
    EXPECT_EQ(word(by_line[6]), "possible");
    EXPECT_EQ(word(by_line[7]), "undecided");  // 65472 + 100 is met by few points
}

/// b - a is 0 only where the constraint is broken: no example.
TEST(Proofs, ShowNoInputThatBreaksAConstraint) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"known.frag",
         "#version 450\nlayout(location = 0) out float color;\nuniform float a;\nuniform float b;\n"
         "void main() { color = 1.0 / (b - a); }\n"}});
    Domain order;
    order.name = "a < b";
    EXPECT_EQ(word(by_rule(proven("known.frag", files, {})).at("division by zero")), "possible");
    EXPECT_EQ(word(by_rule(proven("known.frag", files, {}, {order})).at("division by zero")), "undecided");
}

TEST(Proofs, ClaimNothingOfWhatTheyDoNotCover) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"known.frag",
         "#version 450\nlayout(location = 0) out float color;\nvoid main() { color = 1.0; }\n"}});
    const std::string text = prove::proof_text(proven("known.frag", files, {}));
    EXPECT_NE(text.find(" 0          0         0        0        -\nnot covered: undefined values, missing "
                        "returns, unwritten outputs and constants; gobo sanitize looks for them\n"),
              std::string::npos)
        << text;
}

/// What is an error has its row.
TEST(Proofs, CountConstantsThatAreNotProven) {
    const std::string text = prove::proof_text(proven_text("color = a + 1.0 / total(2.0);"));
    const std::string row =
        "division by zero                                                            1          0         0  "
        " "
        "     1    0.0 %\n";
    EXPECT_NE(text.find(row), std::string::npos) << text;
}

TEST(Proofs, GiveUpLoopsThatMayNeverEnd) {
    const prove::ProveReport report = proven_text(
        "float y = a; int n = 0; while (y != 0.0) { y -= sign(y) * 0.0; ++n; } color = float(n);");
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_EQ(report.diagnostics.front().message,
              "whether the loop ends stays open for 256 turns: nothing is proven of this stage");
    EXPECT_NE(prove::proof_text(report).find("undecided\nknown.frag:6: FMul: "), std::string::npos);
}

TEST(Proofs, AreWrittenAsJson) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"known.frag",
         "#version 450\nlayout(location = 0) in float a;\nlayout(location = 0) out float color;\nvoid main() "
         "{ color = 1.0 / a; }\n"}});
    const std::string json = prove::proof_json(proven("known.frag", files, {}));
    EXPECT_NE(json.find("\"rule\": \"division by zero\",\n     \"status\": \"possible\",\n     \"finding\": "
                        "\"division by zero: FDiv 1, a = 0 -> inf\""),
              std::string::npos)
        << json;
    EXPECT_NE(json.find("\"nan\": true,\n   \"stage\": \"fragment\",\n   \"output\": \"color\""),
              std::string::npos)
        << json;
}

/// A proof that needs the domain split: no single interval tells it.
TEST(Proofs, SplitTheDomain) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"known.frag",
         "#version 450\nlayout(location = 0) in float a;\nlayout(location = 0) out float color;\n"
         "void main() { color = 1.0 / ((a - 150.0) * (a + 150.0) + a * 100.0 + 100.0); }\n"}});
    prove::ProveOptions options;
    options.points = 0;
    options.splits = 0;
    EXPECT_EQ(word(by_rule(proven("known.frag", files, options)).at("division by zero")), "undecided");
    options.splits = 200;
    EXPECT_EQ(word(by_rule(proven("known.frag", files, options)).at("division by zero")), "impossible");
}

/// Shaders that say in comments which traps they have.
class PlantedFault : public testing::TestWithParam<std::string> {};

TEST_P(PlantedFault, IsNeverProvenImpossible) {
    prove::ProveOptions options;
    options.check = 4096;
    options.points = 256;
    const prove::ProveReport report = proven(GetParam(), DiskFileSystem(), options);
    Lines open;
    for (const prove::SourceOperation& operation : report.operations)
        for (const prove::ProvenRule& rule : operation.rules)
            if (rule.status != Status::impossible)
                open.insert(std::to_string(operation.place.line) + ": " + rule.message);
    for (const std::string& mark : marked_lines(GetParam())) {
        const bool is_other = mark.find("is read before it is written") != std::string::npos ||
                              mark.find("the output") != std::string::npos ||
                              mark.find("returns no value") != std::string::npos;
        if (!is_other) {
            EXPECT_TRUE(open.contains(mark)) << mark;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sanitizer, PlantedFault, testing::ValuesIn(shader_files("sanitize/planted")),
                         file_test_name);
INSTANTIATE_TEST_SUITE_P(Plain, PlantedFault, testing::ValuesIn(shader_files("hard_cases/plain")),
                         file_test_name);

}  // namespace
}  // namespace gobo
