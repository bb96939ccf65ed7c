// Values that nobody gives: found where they come to matter, once for each cause, and not where they do not.
#include <ostream>

#include <gtest/gtest.h>

#include "sanitize_support.hpp"

namespace gobo {
namespace {

struct Row {
    std::string name;
    std::string functions;   ///< in line 5
    std::string statements;  ///< in line 8
    Lines found;
    Lines following = {};  ///< what is told beneath
};

std::ostream& operator<<(std::ostream& stream, const Row& row) {
    return stream << row.name;
}

constexpr const char* kUnwritten = "8: a value is read before it is written";
constexpr const char* kNoReturn = "5: a function returns no value on some path";

const Row kRows[] = {
    {"branch", "", "bool near; if (x > 0.0) near = true; if (near) color.x = x;", {kUnwritten}},
    {"choice", "", "bool near; if (x > 0.0) near = true; color.x = near ? 1.0 : x;", {kUnwritten}},
    {"logic", "", "bool near; if (x > 0.0) near = true; if (near && y > 0.0) color.x = x;", {kUnwritten}},
    {"loop",
     "",
     "int n; if (x > 0.0) n = 2; for (int k = 0; k < n && k < 4; ++k) color.x += x;",
     {kUnwritten}},
    {"switch",
     "",
     "int n; if (x > 0.0) n = 2; switch (n) { case 2: color.x = x; break; default: break; }",
     {kUnwritten}},
    {"index", "", "int n; if (x > 0.0) n = 2; color.x = table[n];", {kUnwritten}},
    {"component_index", "", "int n; if (x > 0.0) n = 2; color.x = color[n];", {kUnwritten}},
    {"discard", "", "bool cut; if (x > 0.0) cut = false; if (cut) discard;", {kUnwritten}},
    {"copied_to_the_output", "", "vec4 c; if (x > 0.0) c = vec4(x); color = c;", {kUnwritten}},
    {"part_of_the_output",
     "",
     "vec3 c; if (x > 0.0) c = vec3(x); color.rgb = c;\n    color.a = y;",
     {kUnwritten}},
    {"struct_member",
     "struct Light { float power; float angle; };",
     "Light l; l.power = x; color.x = l.angle;",
     {kUnwritten}},
    {"array_element", "", "float a[3]; a[0] = x; a[1] = y; color.x = a[0] + a[2];", {kUnwritten}},
    {"argument",
     "float twice(float v) { return v * 2.0; }",
     "float v; if (x > 0.0) v = x; color.x = twice(v);",
     {"5: a value is read before it is written"}},
    {"one_cause_used_twice",
     "",
     "float v; if (x > 0.0) v = x; color.x = v + 1.0; color.y = v * v;",
     {kUnwritten}},
    {"trap_of_it",
     "",
     "float v; if (x > 0.0) v = 1.0; color.x = 1.0 / v;",
     {kUnwritten},
     {"8: division by zero"}},
    {"global", "float sum;", "sum += x; color.x = sum;", {kUnwritten}},
    {"no_return",
     "float half_of(float v) { if (v > 0.0) return v * 0.5; }",
     "color.x = half_of(x);",
     {kNoReturn}},
    {"no_return_as_index",
     "int pick(float v) { if (v > 0.0) return 1; }",
     "color.x = table[pick(x)];",
     {kNoReturn}},
    {"no_return_of_bool",
     "bool is_lit(float v) { if (v > 0.0) return true; }",
     "if (is_lit(x)) color.x = x;",
     {kNoReturn}},
    {"no_return_twice",
     "float half_of(float v) { if (v > 0.0) return v * 0.5; }",
     "color.x = half_of(x) + half_of(y);",
     {kNoReturn}},
    {"no_return_of_vector",
     "vec3 tone(float v) { if (v > 0.0) return vec3(v); }",
     "color.rgb = tone(x);",
     {kNoReturn}},
    {"two_causes",
     "float half_of(float v) { if (v > 0.0) return v * 0.5; }",
     "float w; if (x <= 0.0) w = x; color.x = half_of(x) + w;",
     {kNoReturn, kUnwritten}},
    // What must stay silent.
    {"harmless_written_on_both_paths",
     "",
     "bool near; if (x > 0.0) near = true; else near = false; color.x = near ? 1.0 : x;",
     {}},
    {"harmless_unused_component", "", "vec4 c; c.xyz = vec3(x); c *= 2.0; color.xyz = c.xyz;", {}},
    {"harmless_unused_result", "", "float v; float w = v * 2.0; color.x = x;", {}},
    {"harmless_not_chosen", "", "float v; if (x > 0.0) v = x; color.x = x > 0.0 ? v : 0.0;", {}},
    {"harmless_masked_out", "", "float v; if (x > 0.0) v = x; if (x > 0.0) color.x = v + 1.0;", {}},
    {"harmless_returns",
     "float half_of(float v) { if (v > 0.0) return v * 0.5; return 0.0; }",
     "color.x = half_of(x);",
     {}},
    {"harmless_return_unused",
     "float half_of(float v) { if (v > 0.0) return v * 0.5; }",
     "float h = half_of(x); color.x = x > 0.0 ? h : 0.0;",
     {}},
    {"harmless_out_argument",
     "void fill(out vec3 v) { v = vec3(1.0); }",
     "vec3 v; fill(v); color.rgb = v * 2.0;",
     {}},
    {"harmless_loop",
     "",
     "float sum; for (int k = 0; k < 3; ++k) { if (k == 0) sum = x; else sum += x; } color.x = sum;",
     {}},
    {"harmless_array", "", "float a[3]; for (int k = 0; k < 3; ++k) a[k] = x; color.x = a[0] + a[2];", {}},
    {"harmless_discarded", "", "float v; if (x > 0.0) v = x; else discard; color.x = v + 1.0;", {}},
};

std::string shader_with(const Row& row) {
    return "#version 450\n"
           "in float x; in float y;\n"
           "uniform float table[3];\n"
           "out vec4 color;\n" +
           row.functions + "\nvoid main() {\n    color = vec4(0.0);\n" + row.statements + "\n}\n";
}

class Undefined : public testing::TestWithParam<Row> {};

TEST_P(Undefined, IsFoundWhereItMatters) {
    const std::string text = shader_with(GetParam());
    const sanitize::SanitizeReport report = sanitized_text("undefined.frag", text, {});
    EXPECT_EQ(found_lines(report), GetParam().found);
    EXPECT_EQ(consequences(report), GetParam().following);
    EXPECT_EQ(not_replayed("undefined.frag", text, report), Lines{});
}

INSTANTIATE_TEST_SUITE_P(Rows, Undefined, testing::ValuesIn(kRows), row_name);

/// A stage whose main() does nothing has no operation to be watched.
TEST(UndefinedOutputs, OfAnEmptyStageAreFound) {
    const sanitize::SanitizeReport report =
        sanitized_text("empty.frag", "#version 450\nout vec4 color;\nvoid main() {}\n", {});
    EXPECT_EQ(found_lines(report), Lines{"0: the output 'color' is never written"});
    EXPECT_EQ(report.findings.front().finding.place.file, "empty.frag");
    EXPECT_EQ(report.findings.front().finding.points, report.points);
}

}  // namespace
}  // namespace gobo
