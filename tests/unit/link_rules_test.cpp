// The rules that glslang forgets: versions that make no program, what glslang takes of a stage alone, faults
// of the input, and how many messages there are.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/selection.hpp"
#include "link_row.hpp"
#include "small_families.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using testing::HasSubstr;

struct Versions {
    const char* vertex;
    const char* fragment;
    std::string message;  ///< empty where they go together
};

/// Mesa 22.3 crashes on it.
TEST(LinkRules, TellOfAUniformCalledAsABlock) {
    const Diagnostics found = checked(
        "#version 450\nlayout(std140) uniform Tint { vec4 v; } b;\nvoid main() { gl_Position = b.v; }\n",
        "#version 450\nuniform vec4 Tint;\nout vec4 c;\nvoid main() { c = Tint; }\n");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(to_text(found.front()),
              "tiny.frag:2: error: 'Tint' is a uniform here, and a block in tiny.vert:2 [default]\n"
              "    uniform vec4 Tint;\n  help: rename one of them: some drivers take them for one\n");
}

TEST(LinkRules, TellOfVersionsThatMakeNoProgram) {
    const Versions rows[] = {
        {"330", "300 es", "GLSL ES 300, but tiny.vert is GLSL 330"},
        {"450", "310 es", "GLSL ES 310, but tiny.vert is GLSL 450"},
        {"300 es", "330", "GLSL 330, but tiny.vert is GLSL ES 300"},
        {"300 es", "310 es", "GLSL ES 310, but tiny.vert is GLSL ES 300"},
        {"330", "450", ""},
        {"310 es", "310 es", ""},
    };
    for (const Versions& row : rows) {
        SCOPED_TRACE(fmt::format("{} with {}", row.vertex, row.fragment));
        const Diagnostics found =
            checked(fmt::format("#version {}\nvoid main() {{ gl_Position = vec4(0.0); }}\n", row.vertex),
                    fmt::format("#version {}\nprecision highp float;\nlayout(location = 0) out vec4 c;\n"
                                "void main() {{ c = vec4(1.0); }}\n",
                                row.fragment));
        ASSERT_EQ(found.size(), row.message.empty() ? 0U : 1U);
        if (found.empty()) continue;
        EXPECT_EQ(to_text(found.front()),
                  "tiny.frag: error: this stage is " + row.message +
                      ": they make no program [default]\n  help: state the same #version in both\n");
    }
}

class StageRules : public testing::TestWithParam<LinkRow> {};

TEST_P(StageRules, AreToldAndAgreeWithMesa) {
    expect_verdicts(GetParam());
}

const LinkRow language[] = {
    {"member_offset_misaligned",
     "450",
     plain,
     "layout(std140, binding = 0) uniform B { layout(offset = 0) vec3 first;\n"
     "    layout(offset = 12) vec4 second; } b;\nout vec4 c;\n"
     "void main() { c = vec4(b.first, 1.0) + b.second; }\n",
     Mesa::refuses,
     {"tiny.frag:3: error: 'offset' : must be a multiple of the member's alignment: 12 is not a multiple of "
      "16, to which a vec4 is aligned"}},
    {"lod_query",
     "330 core",
     plain,
     "uniform sampler2D map;\nout vec4 c;\nvoid main() { c = vec4(textureQueryLod(map, vec2(0.5)), 0.0, "
     "1.0); }\n",
     Mesa::refuses,
     {"tiny.frag:4: error: textureQueryLod() came with GLSL 4.00"}},
    {"lod_query_by_extension",
     "330 core",
     plain,
     "#extension GL_ARB_texture_query_lod : require\nuniform sampler2D map;\nout vec4 c;\n"
     "void main() { c = vec4(textureQueryLOD(map, vec2(0.5)), 0.0, 1.0); }\n",
     Mesa::links,
     {}},
    {"block_indexed_by_a_variable",
     "330 core",
     plain,
     "layout(std140) uniform B { vec4 v; } b[2];\nuniform int k;\nout vec4 c;\nvoid main() { c = b[k].v; }\n",
     Mesa::refuses,
     {"the array of blocks 'B' is indexed by what is no constant, which came with GLSL 4.00"}},
    {"block_indexed_by_a_constant",
     "330 core",
     plain,
     "layout(std140) uniform B { vec4 v; } b[2];\nout vec4 c;\nvoid main() { c = b[1].v; }\n",
     Mesa::links,
     {}},
    {"constant_of_vulkan",
     "450",
     plain,
     "layout(constant_id = 0) const int k = 3;\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(k); "
     "}\n",
     Mesa::refuses,
     {"tiny.frag:2: error: OpenGL's GLSL has no constant_id: it is Vulkan's"}},
    {"function_without_body_called_by_none",
     "330 core",
     plain,
     "float g(float x);\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::links,
     {}},
    {"function_without_body_called_by_an_uncalled_one",
     "330 core",
     plain,
     "float g(int x) { return 1.0; }\nfloat g(float x);\nfloat f(float x) { return g(x); }\nout vec4 c;\n"
     "void main() { c = vec4(g(1)); }\n",
     Mesa::refuses,
     {"error: the function 'g' has no body"}},
    {"sample_mask_beyond_the_first",
     "450",
     plain,
     "out vec4 c;\nvoid main() { c = vec4(1.0); gl_SampleMask[1] = 3; }\n",
     Mesa::refuses,
     {kNewerGlslang
          ? "tiny.frag:3: error: '[' : gl_SampleMask array index out of range '1'"
          : "tiny.frag:3: error: elements of gl_SampleMask up to the last: 2, OpenGL guarantees only "
            "1 (MAX_SAMPLE_MASK_WORDS)"}},
    {"sample_mask_of_the_first",
     "450",
     plain,
     "out vec4 c;\nvoid main() { c = vec4(gl_SampleMaskIn[0]); gl_SampleMask[0] = 3; }\n",
     Mesa::links,
     {}},
    {"fragment_data_beyond_the_last",
     "110",
     plain,
     "void main() { gl_FragData[8] = vec4(1.0); }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: elements of gl_FragData up to the last: 9, OpenGL guarantees only 8 "
      "(MAX_DRAW_BUFFERS)"}},
    {"struct_in_a_parameter",
     "450",
     plain,
     "float f(in struct S { float a; } s) { return s.a; }\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: a struct is declared in the head of the function 'f'"}},
    {"struct_as_what_a_function_returns",
     "330 core",
     plain,
     "struct S { float a; } f() { return S(1.0); }\nout vec4 c;\nvoid main() { c = vec4(f().a); }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: a struct is declared in the head of the function 'f'"}},
    {"layout_behind_a_function",
     "450",
     plain,
     "float f() { return 1.0; }\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(f()); }\n",
     Mesa::links,
     {}},
    {"struct_of_a_uniform",
     "450",
     plain,
     "layout(location = 1) uniform struct S { float a; } s;\nconst struct T { float a; } t = T(1.0);\nout "
     "vec4 c;\n"
     "void main() { c = vec4(s.a + t.a); }\n",
     Mesa::links,
     {}},
    {"offsets_that_fall",
     "450",
     plain,
     "layout(std140) uniform B {\n    layout(offset = 32) vec4 a;\n    layout(offset = 0) vec4 b;\n};\n"
     "out vec4 c;\nvoid main() { c = a + b; }\n",
     Mesa::refuses,
     {"tiny.frag:4: error: 'b' has offset 0, before that of 'a', which stands above it"}},
    {"offset_within_the_member_above",
     "450",
     plain,
     "layout(std140) uniform B {\n    mat3 a[3];\n    layout(offset = 48) vec4 b;\n};\nout vec4 c;\n"
     "void main() { c = b; }\n",
     Mesa::refuses,
     {"tiny.frag:4: error: 'b' has offset 48, within that of 'a', which stands above it"}},
    {"offset_in_a_block_without_layout",
     "450",
     plain,
     "uniform B { layout(offset = 16) vec4 a; };\nout vec4 c;\nvoid main() { c = a; }\n",
     Mesa::refuses,
     {"tiny.frag:2: warning: the uniform block 'B' does not state std140",
      "tiny.frag:2: error: 'offset' in the block 'B', which states neither std140 nor std430"}},
    {"offset_in_a_block_with_a_default_layout",
     "450",
     plain,
     "layout(std140) uniform;\nuniform B { layout(offset = 16) vec4 a; };\nout vec4 c;\n"
     "void main() { c = a; }\n",
     Mesa::links,
     {}},
};

INSTANTIATE_TEST_SUITE_P(Language, StageRules, testing::ValuesIn(language), name_of_row);

/// Faults of the input that used to count as gobo's own.
struct FaultRow {
    const char* name;
    const char* fragment;
    const char* message;
};

void PrintTo(const FaultRow& row, std::ostream* stream) {
    *stream << row.name;
}

class FaultOfTheInput : public testing::TestWithParam<FaultRow> {};

TEST_P(FaultOfTheInput, EndsWithStatusOne) {
    const Diagnostics found = checked(plain, GetParam().fragment);
    EXPECT_EQ(exit_status(found), 1);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_THAT(to_text(found.front()), HasSubstr(GetParam().message));
}

std::string nested_structs() {
    std::string text = "struct S0 { float x; };\n";
    for (int i = 1; i < 300; ++i) text += fmt::format("struct S{} {{ S{} s; }};\n", i, i - 1);
    return text + "uniform S299 s;\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n";
}
const std::string deep = nested_structs();

INSTANTIATE_TEST_SUITE_P(
    Rows, FaultOfTheInput,
    testing::Values(FaultRow{"recursion",
                             "out vec4 c;\nfloat f(float x) { return x < 0.0 ? 0.0 : f(x - 1.0); }\n"
                             "void main() { c = vec4(f(1.0)); }\n",
                             "tiny.frag:2: error: the function 'f' calls itself"},
                    FaultRow{"no_main", "float f() { return 1.0; }\n",
                             "tiny.frag: error: the fragment stage has no main()"},
                    FaultRow{"empty", "\n", "the fragment stage has no main()"},
                    FaultRow{"block_too_large",
                             "layout(std140, binding = 0) uniform B { vec4 q[134217728]; };\nout vec4 c;\n"
                             "void main() { c = q[1]; }\n",
                             "tiny.frag:1: error: block 'B' takes more than 2 GiB"},
                    FaultRow{
                        "too_many_blocks",
                        "layout(std140, binding = 0) uniform B { float x; } b[2000000000];\nout vec4 c;\n"
                        "void main() { c = vec4(b[1].x); }\n",
                        "tiny.frag:1: error: block 'B' is an array of too many blocks"},
                    FaultRow{"too_many_inputs",
                             "layout(location = 0) in float q[2000000000];\nout vec4 c;\n"
                             "void main() { c = vec4(q[0]); }\n",
                             "tiny.frag:1: error: variable 'q' takes too many locations"},
                    FaultRow{"structs_nested_too_deeply", deep.c_str(),
                             "tiny.frag: error: types are nested more than 255 deep"}),
    [](const auto& row) { return std::string(row.param.name); });

/// One cause is one message, whatever its number in each key.
TEST(ManyKeys, AreOneMessage) {
    const std::map<std::string, std::string, std::less<>> files = {
        {"tiny.vert", plain},
        {"tiny.frag",
         "#if LAMPS > 0\nlayout(std140, binding = 0) uniform Lamps { vec4 lamps[LAMPS * 300]; };\n"
         "#endif\nout vec4 c;\nvoid main() {\n#if LAMPS > 0\n    c = lamps[0];\n#else\n"
         "    c = vec4(0.0);\n#endif\n}\n"}};
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("[features]\nlamps = { count = [0, 9], constant = \"LAMPS\" }\n");
    Selection selection;
    selection.all = true;
    const Composition composition =
        compose(family, select(family, selection, "450").value(), search, Dialect::own).value();
    const Diagnostics found = validate(family, composition, {}).diagnostics;
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(to_text(found.front()),
              "tiny.frag:2: error: bytes of the uniform block 'Lamps': 19200, OpenGL guarantees only 16384 "
              "(MAX_UNIFORM_BLOCK_SIZE) [lamps=4, and 5 more keys]\n"
              "    layout(std140, binding = 0) uniform Lamps { vec4 lamps[LAMPS * 300]; };\n"
              "  help: use fewer, or forbid the combination by a rule of the family\n");
}

}  // namespace
}  // namespace gobo
