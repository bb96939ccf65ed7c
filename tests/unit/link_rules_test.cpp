// The rules that glslang forgets: what gobo says of a pair, and whether Mesa links it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/selection.hpp"
#include "lab/render/program.hpp"
#include "small_families.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using testing::HasSubstr;

/// What Mesa makes of the pair.
enum class Mesa {
    links,
    refuses,
    is_lax,  ///< links, though the specification or a guaranteed limit is offended
};

struct Row {
    const char* name;
    const char* version;
    const char* vertex;
    const char* fragment;
    Mesa mesa;
    std::vector<const char*> messages;  ///< each that gobo gives, in part
};

void PrintTo(const Row& row, std::ostream* stream) {
    *stream << row.name;
}

Diagnostics checked(const std::string& vertex, const std::string& fragment) {
    const std::map<std::string, std::string, std::less<>> files = {{"tiny.vert", vertex},
                                                                   {"tiny.frag", fragment}};
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("");
    const Composition composition = compose(family, {{}}, search, Dialect::own).value();
    return validate(family, composition, {}).diagnostics;
}

class LinkRule : public testing::TestWithParam<Row> {};

TEST_P(LinkRule, IsToldAndAgreesWithMesa) {
    const Row& row = GetParam();
    const std::string head = std::string("#version ") + row.version + "\n";
    const bool is_es = head.ends_with("es\n") || head.ends_with(" 100\n");
    const std::string vertex = head + row.vertex;
    const std::string fragment = head + (is_es ? "precision highp float;\n" : "") + row.fragment;
    const Diagnostics found = checked(vertex, fragment);
    std::string all;
    for (const Diagnostic& diagnostic : found) all += to_text(diagnostic);
    ASSERT_EQ(found.size(), row.messages.size()) << all;
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_THAT(to_text(found[i]), HasSubstr(row.messages[i])) << all;
    EXPECT_EQ(exit_status(found), row.mesa == Mesa::links ? 0 : 1) << all;

    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context.has_value());
    const Result<Program> program =
        link_program(*context, {stage_text(StageKind::vertex, "tiny.vert", vertex),
                                stage_text(StageKind::fragment, "tiny.frag", fragment)});
    EXPECT_EQ(program.has_value(), row.mesa != Mesa::refuses)
        << (program ? "it links" : to_text(program.error().front()));
}

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

constexpr const char* plain = "void main() { gl_Position = vec4(0.0); }\n";
constexpr const char* color = "out vec4 c;\nvoid main() { c = vec4(1.0); }\n";

const Row varyings[] = {
    {"flat_meets_smooth_330",
     "330 core",
     "out vec3 s;\nvoid main() { s = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "flat in vec3 s;\nout vec4 c;\nvoid main() { c = vec4(s, 1.0); }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: 's' is flat here, but smooth in tiny.vert:2: before GLSL 4.40"}},
    {"flat_meets_smooth_450",
     "450",
     "out vec3 s;\nvoid main() { s = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "flat in vec3 s;\nout vec4 c;\nvoid main() { c = vec4(s, 1.0); }\n",
     Mesa::links,
     {}},
    {"flat_meets_smooth_es300",
     "300 es",
     "out vec3 s;\nvoid main() { s = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "flat in vec3 s;\nout vec4 c;\nvoid main() { c = vec4(s, 1.0); }\n",
     Mesa::refuses,
     {"tiny.frag:3: error: 's' is flat here, but smooth in tiny.vert:2: OpenGL ES"}},
    {"noperspective_meets_smooth_330",
     "330 core",
     "out vec3 s;\nvoid main() { s = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "noperspective in vec3 s;\nout vec4 c;\nvoid main() { c = vec4(s, 1.0); }\n",
     Mesa::refuses,
     {"'s' is noperspective here, but smooth in tiny.vert:2"}},
    {"types_by_name",
     "450",
     "out vec3 s;\nvoid main() { s = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "in vec4 s;\nout vec4 c;\nvoid main() { c = s; }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: 's' is vec4 here, but vec3 in tiny.vert:2 [default]\n    in vec4 s;\n"}},
    {"types_by_location",
     "450",
     "layout(location = 1) out vec3 s;\nvoid main() { s = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "layout(location = 1) in vec2 t;\nout vec4 c;\nvoid main() { c = t.xyxy; }\n",
     Mesa::refuses,
     {"'t' (location 1, 's' in the vertex stage) is vec2 here, but vec3 in tiny.vert:2"}},
    {"extents_by_location",
     "450",
     "layout(location = 1) out vec3 s[2];\nvoid main() { s[0] = s[1] = vec3(1.0); gl_Position = vec4(0.0); "
     "}\n",
     "layout(location = 1) in vec3 s[3];\nout vec4 c;\nvoid main() { c = s[2].xyzx; }\n",
     Mesa::refuses,
     {"'s' is vec3[3] here, but vec3[2] in tiny.vert:2"}},
    {"located_in_one_stage",
     "450",
     "out vec3 s;\nvoid main() { s = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "layout(location = 1) in vec3 s;\nout vec4 c;\nvoid main() { c = s.xyzx; }\n",
     Mesa::refuses,
     {"it has location 1 here, and no location in tiny.vert:2"}},
    {"unread_and_undeclared",
     "330 core",
     plain,
     "in vec2 gone;\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::links,
     {}},
    {"unread_and_undeclared_located",
     "450",
     plain,
     "layout(location = 3) in vec2 gone;\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::links,
     {}},
    {"read_and_undeclared_located",
     "450",
     plain,
     "layout(location = 3) in vec2 gone;\nout vec4 c;\nvoid main() { c = gone.xyxy; }\n",
     Mesa::refuses,
     {"the fragment stage reads 'vec2 gone', which the vertex stage does not write"}},
    {"read_and_undeclared",
     "330 core",
     plain,
     "in vec2 gone;\nout vec4 c;\nvoid main() { c = gone.xyxy; }\n",
     Mesa::is_lax,
     {"tiny.frag:2: error: the fragment stage reads 'vec2 gone', which the vertex stage"}},
    {"read_and_never_stored",
     "450",
     "out vec3 s;\nvoid main() { gl_Position = vec4(0.0); }\n",
     "in vec3 s;\nout vec4 c;\nvoid main() { c = s.xyzx; }\n",
     Mesa::links,
     {"tiny.frag:2: warning: the fragment stage reads 's', which the vertex stage declares in tiny.vert:2 "
      "and "
      "never writes"}},
    {"sample_in_one_stage",
     "450",
     "out vec3 s;\nvoid main() { s = vec3(1.0); gl_Position = vec4(0.0); }\n",
     "sample in vec3 s;\nout vec4 c;\nvoid main() { c = s.xyzx; }\n",
     Mesa::refuses,
     {"'s' is sample here, but neither in tiny.vert:2"}},
    {"member_of_a_block_between_stages",
     "330 core",
     "out Surface { vec3 normal; vec2 uv; } o;\n"
     "void main() { o.normal = vec3(1.0); o.uv = vec2(0.0); gl_Position = vec4(0.0); }\n",
     "in Surface { flat vec3 normal; vec2 uv; } i;\nout vec4 c;\nvoid main() { c = i.normal.xyzx + "
     "i.uv.xyxy; }\n",
     Mesa::refuses,
     {"'Surface.normal' is flat here, but smooth in tiny.vert:2"}},
    {"flat_beside_smooth_at_one_location",
     "450",
     "layout(location = 1) flat out vec2 a;\nlayout(location = 1, component = 2) out vec2 b;\n"
     "void main() { a = b = vec2(1.0); gl_Position = vec4(0.0); }\n",
     "layout(location = 1) flat in vec2 a;\nlayout(location = 1, component = 2) in vec2 b;\nout vec4 c;\n"
     "void main() { c = vec4(a, 0.0, 1.0); }\n",
     Mesa::refuses,
     {"tiny.vert:3: error: 'vec2 a' and 'vec2 b' share location 1 and are flat and smooth",
      "tiny.frag:3: error: 'vec2 a' and 'vec2 b' share location 1 and are flat and smooth"}},
    {"centroid_beside_an_array",
     "450",
     "layout(location = 1) out vec2 a[2];\nlayout(location = 2, component = 2) centroid out vec2 b;\n"
     "void main() { a[0] = a[1] = b = vec2(1.0); gl_Position = vec4(0.0); }\n",
     "layout(location = 1) in vec2 a[2];\nlayout(location = 2, component = 2) in vec2 b;\nout vec4 c;\n"
     "void main() { c = vec4(a[1], b); }\n",
     Mesa::refuses,
     {"tiny.vert:3: error: 'vec2 a' and 'vec2 b' share location 2 and are smooth and smooth centroid"}},
    {"numbers_beside_an_array",
     "450",
     "layout(location = 1) flat out vec2 a[2];\nlayout(location = 2, component = 2) flat out ivec2 b;\n"
     "void main() { a[0] = a[1] = vec2(1.0); b = ivec2(1); gl_Position = vec4(0.0); }\n",
     color,
     Mesa::refuses,
     {"tiny.vert:3: error: 'vec2 a' and 'ivec2 b' share location 2 and have not one numerical type"}},
    {"alike_at_one_location",
     "450",
     "layout(location = 1) flat out vec2 a;\nlayout(location = 1, component = 2) flat out vec2 b;\n"
     "void main() { a = b = vec2(1.0); gl_Position = vec4(0.0); }\n",
     "layout(location = 1) flat in vec2 a;\nlayout(location = 1, component = 2) flat in vec2 b;\nout vec4 "
     "c;\n"
     "void main() { c = vec4(a, b); }\n",
     Mesa::links,
     {}},
    {"block_meets_a_variable",
     "450",
     "layout(location = 1) out Surface { vec4 tint; } o;\nvoid main() { o.tint = gl_Position = vec4(0.0); "
     "}\n",
     "layout(location = 1) in vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: 'tint' (location 1, 'Surface.tint' in the vertex stage) is no member of a block "
      "here, but a member of a block in tiny.vert:2"}},
    {"centroid_of_a_member_of_a_block",
     "450",
     "out Surface { centroid vec4 tint; } o;\nvoid main() { o.tint = gl_Position = vec4(0.0); }\n",
     "in Surface { vec4 tint; } o;\nout vec4 c;\nvoid main() { c = o.tint; }\n",
     Mesa::refuses,
     {"'Surface.tint' is not centroid here, but centroid in tiny.vert:2: the members of a block must agree"}},
    {"centroid_of_a_variable",
     "450",
     "centroid out vec4 tint;\nvoid main() { tint = gl_Position = vec4(0.0); }\n",
     "in vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::links,
     {}},
    {"invariant_member_of_a_block",
     "330 core",
     "out Surface { invariant vec4 tint; } o;\nvoid main() { o.tint = gl_Position = vec4(0.0); }\n",
     "in Surface { vec4 tint; } o;\nout vec4 c;\nvoid main() { c = o.tint; }\n",
     Mesa::links,
     {}},
};

const Row names[] = {
    {"anonymous_member_and_uniform",
     "450",
     "layout(std140, binding = 0) uniform Frame { vec4 tint; };\nvoid main() { gl_Position = tint; }\n",
     "uniform vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: 'tint' is a uniform here, but a member of the block 'Frame' in tiny.vert:2"}},
    {"anonymous_members_of_two_blocks",
     "450",
     "layout(std140, binding = 0) uniform Frame { vec4 tint; };\nvoid main() { gl_Position = tint; }\n",
     "layout(std140, binding = 1) uniform Surface { vec4 tint; };\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"'tint' is a member of the block 'Surface' here, but a member of the block 'Frame' in tiny.vert:2"}},
    {"anonymous_member_of_lines",
     "450",
     "layout(std140, binding = 0) uniform Frame {\n    mat4 m;\n    vec4 tint;\n};\n"
     "void main() { gl_Position = tint; }\n",
     "#ifdef NEVER\nlayout(std140, binding = 1) uniform Surface { vec4 tint; };\n#else\nuniform vec4 tint;\n"
     "#endif\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"tiny.frag:5: error: 'tint' is a uniform here, but a member of the block 'Frame' in tiny.vert:4"}},
    {"types_of_a_uniform",
     "330 core",
     "uniform vec3 tint;\nvoid main() { gl_Position = tint.xyzx; }\n",
     "uniform vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: 'tint' is vec4 here, but vec3 in tiny.vert:2"}},
    {"uniform_and_sampler",
     "330 core",
     "uniform vec3 tint;\nvoid main() { gl_Position = tint.xyzx; }\n",
     "uniform sampler2D tint;\nout vec4 c;\nvoid main() { c = texture(tint, vec2(0.0)); }\n",
     Mesa::refuses,
     {"'tint' is sampler2D here, but vec3 in tiny.vert:2"}},
    {"locations_of_a_uniform",
     "450",
     "layout(location = 1) uniform vec4 tint;\nvoid main() { gl_Position = tint; }\n",
     "layout(location = 2) uniform vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"'tint' is at location 2 here, but at 1 in tiny.vert:2"}},
    {"locations_of_two_uniforms",
     "450",
     "layout(location = 1) uniform vec4 tint[3];\nvoid main() { gl_Position = tint[2]; }\n",
     "layout(location = 3) uniform vec4 tone;\nout vec4 c;\nvoid main() { c = tone; }\n",
     Mesa::refuses,
     {"the uniforms 'tone' and 'tint' (tiny.vert:2) share location 3"}},
    {"bindings_of_a_sampler",
     "450",
     "layout(binding = 1) uniform sampler2D map;\nvoid main() { gl_Position = texture(map, vec2(0.0)); }\n",
     "layout(binding = 2) uniform sampler2D map;\nout vec4 c;\nvoid main() { c = texture(map, vec2(0.0)); "
     "}\n",
     Mesa::refuses,
     {"'map' is at binding 2 here, but at 1 in tiny.vert:2"}},
    {"precision_es300",
     "300 es",
     "uniform mediump vec4 tint;\nvoid main() { gl_Position = tint; }\n",
     "uniform highp vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"'tint' is highp here, but mediump in tiny.vert:2"}},
    {"precision_of_a_sampler_es300",
     "300 es",
     "uniform highp sampler2D map;\nvoid main() { gl_Position = texture(map, vec2(0.0)); }\n",
     "uniform sampler2D map;\nout vec4 c;\nvoid main() { c = texture(map, vec2(0.0)); }\n",
     Mesa::refuses,
     {"'map' is lowp here, but highp in tiny.vert:2"}},
    {"members_of_a_block",
     "450",
     "layout(std140, binding = 0) uniform Camera { mat4 m; vec4 eye; } camera;\n"
     "void main() { gl_Position = camera.m * camera.eye; }\n",
     "layout(std140, binding = 0) uniform Camera { mat4 m; vec3 eye; } camera;\nout vec4 c;\n"
     "void main() { c = camera.eye.xyzx; }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: the block 'Camera' has 'vec3 eye' at offset 64 here, but 'vec4 eye' at offset 64 "
      "in "
      "tiny.vert:2"}},
    {"instance_of_a_block",
     "450",
     "layout(std140, binding = 0) uniform Camera { mat4 m; } camera;\n"
     "void main() { gl_Position = camera.m[0]; }\n",
     "layout(std140, binding = 0) uniform Camera { mat4 m; };\nout vec4 c;\nvoid main() { c = m[1]; }\n",
     Mesa::refuses,
     {"the block 'Camera' has no instance name here, but one in tiny.vert:2"}},
    {"formats_of_an_image",
     "450",
     "layout(rgba8, binding = 0) uniform image2D map;\n"
     "void main() { gl_Position = vec4(imageSize(map).xyxy); }\n",
     "layout(rgba16f, binding = 0) uniform image2D map;\nout vec4 c;\n"
     "void main() { c = vec4(imageSize(map).xyxy); }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: 'map' is of format rgba16f here, but of format rgba8 in tiny.vert:2"}},
    {"no_format_of_an_unread_image",
     "450",
     "layout(rgba8, binding = 0) writeonly uniform image2D map[2];\nvoid main() { gl_Position = vec4(0.0); "
     "}\n",
     "layout(binding = 0) writeonly uniform image2D map[2];\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::refuses,
     {"'map' is of no format here, but of format rgba8 in tiny.vert:2"}},
    {"one_format_of_an_image",
     "450",
     "layout(r32f, binding = 0) coherent uniform image2D map;\nvoid main() { gl_Position = vec4(0.0); }\n",
     "layout(r32f, binding = 0) coherent uniform image2D map;\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::links,
     {}},
    {"precision_es100",
     "100",
     "uniform mediump vec4 tint;\nvoid main() { gl_Position = tint; }\n",
     "uniform highp vec4 tint;\nvoid main() { gl_FragColor = tint; }\n",
     Mesa::refuses,
     {"'tint' is highp here, but mediump in tiny.vert:2"}},
    {"precision_of_an_unread_uniform_es100",
     "100",
     "uniform mediump vec4 tint;\nvoid main() { gl_Position = vec4(0.0); }\n",
     "uniform highp vec4 tint;\nvoid main() { gl_FragColor = tint; }\n",
     Mesa::links,
     {}},
    {"low_and_medium_precision",
     "300 es",
     "uniform lowp vec4 tint;\nvoid main() { gl_Position = tint; }\n",
     "uniform mediump vec4 tint;\nout vec4 c;\nvoid main() { c = tint; }\n",
     Mesa::refuses,
     {"'tint' is mediump here, but lowp in tiny.vert:2"}},
    {"precision_of_a_struct",
     "300 es",
     "struct S { vec4 tint; mediump float gloss; };\nuniform S s;\nvoid main() { gl_Position = s.tint; }\n",
     "struct S { vec4 tint; float gloss; };\nuniform S s;\nout vec4 c;\nvoid main() { c = s.tint; }\n",
     Mesa::refuses,
     {"tiny.frag:4: error: 's' is S { highp vec4 tint; highp float gloss } here, but S { highp vec4 tint; "
      "mediump float gloss } in tiny.vert:3"}},
    {"precision_of_an_unread_struct_es100",
     "100",
     "struct T { lowp vec4 tint; };\nstruct S { T t; };\nuniform S s[2];\n"
     "void main() { gl_Position = vec4(0.0); }\n",
     "struct T { mediump vec4 tint; };\nstruct S { T t; };\nuniform S s[2];\n"
     "void main() { gl_FragColor = vec4(1.0); }\n",
     Mesa::refuses,
     {"'s' is S[2] { T { mediump vec4 tint } t } here, but S[2] { T { lowp vec4 tint } t } in tiny.vert:4"}},
    {"precision_of_a_sampler_in_a_struct",
     "300 es",
     "struct S { highp sampler2D map; };\nuniform S s;\n"
     "void main() { gl_Position = texture(s.map, vec2(0.0)); }\n",
     "struct S { lowp sampler2D map; };\nuniform S s;\nout vec4 c;\n"
     "void main() { c = texture(s.map, vec2(0.0)); }\n",
     Mesa::refuses,
     {"'s.map' is lowp here, but highp in tiny.vert:3"}},
    {"precision_of_a_blocks_member",
     "300 es",
     "uniform B { mediump vec4 tint; } b;\nvoid main() { gl_Position = b.tint; }\n",
     "uniform B { highp vec4 tint; } b;\nout vec4 c;\nvoid main() { c = b.tint; }\n",
     Mesa::links,
     {}},
    {"access_to_a_storage_block",
     "450",
     "layout(std430, binding = 0) buffer B { vec4 x; vec4 y[]; } b;\nvoid main() { gl_Position = b.x; }\n",
     "layout(std430, binding = 0) coherent readonly buffer B { vec4 x; vec4 y[]; } b;\nout vec4 c;\n"
     "void main() { c = b.x; }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: the block 'B' has 'x' coherent readonly here, but 'x' without qualifiers of "
      "memory in "
      "tiny.vert:2"}},
    {"binding_of_a_block_in_one_stage",
     "450",
     "layout(std140, binding = 1) uniform B { vec4 tint; } b;\nvoid main() { gl_Position = b.tint; }\n",
     "layout(std140) uniform B { vec4 tint; } b;\nout vec4 c;\nvoid main() { c = b.tint; }\n",
     Mesa::refuses,
     {"the block 'B' has no binding here, but binding 1 in tiny.vert:2"}},
    {"binding_0_of_a_block_in_one_stage",
     "450",
     "layout(std140, binding = 0) uniform B { vec4 tint; } b;\nvoid main() { gl_Position = b.tint; }\n",
     "layout(std140) uniform B { vec4 tint; } b;\nout vec4 c;\nvoid main() { c = b.tint; }\n",
     Mesa::links,
     {}},
    {"uniform_block_and_storage_block",
     "450",
     "layout(std140) uniform B { vec4 tint; } b;\nvoid main() { gl_Position = b.tint; }\n",
     "layout(std430) buffer B { vec4 tone; } b;\nout vec4 c;\nvoid main() { c = b.tone; }\n",
     Mesa::refuses,
     {"the block 'B' has 'vec4 tone' at offset 0 here, but 'vec4 tint' at offset 0 in tiny.vert:2"}},
};

const Row places[] = {
    {"blocks_at_one_binding",
     "450",
     "layout(std140, binding = 0) uniform Camera { mat4 m; } camera;\nvoid main() { gl_Position = "
     "camera.m[0]; }\n",
     "layout(std140, binding = 0) uniform Light { vec4 tint; } light;\nout vec4 c;\nvoid main() { c = "
     "light.tint; }\n",
     Mesa::links,
     {"tiny.frag:2: warning: the blocks 'Light' and 'Camera' (tiny.vert:2) share binding 0"}},
    {"block_on_an_element",
     "450",
     plain,
     "layout(std140, binding = 1) uniform Lamp { vec4 tint; } lamps[3];\n"
     "layout(std140, binding = 2) uniform Sky { vec4 tint; } sky;\nout vec4 c;\n"
     "void main() { c = lamps[1].tint + sky.tint; }\n",
     Mesa::links,
     {"tiny.frag:3: warning: the blocks 'Sky' and 'Lamp[1]' (tiny.frag:2) share binding 2"}},
    {"attribute_behind_the_start_of_a_matrix",
     "330 core",
     "layout(location = 0) in mat4 m;\nlayout(location = 2) in vec4 q;\nvoid main() { gl_Position = m * q; "
     "}\n",
     color,
     Mesa::links,
     {"tiny.vert:3: warning: the attributes 'vec4 q' and 'mat4 m' (tiny.vert:2) share location 2: OpenGL "
      "takes "
      "it only where no path reads both"}},
    {"two_attributes_of_one_location",
     "450",
     "layout(location = 1) in vec4 p;\nlayout(location = 1) in vec4 q;\nvoid main() { gl_Position = p + q; "
     "}\n",
     color,
     Mesa::links,
     {"tiny.vert:3: warning: the attributes 'vec4 q' and 'vec4 p' (tiny.vert:2) share location 1"}},
    {"attributes_that_are_apart",
     "450",
     "layout(location = 0) in mat3 m;\nlayout(location = 3) in vec2 p;\n"
     "layout(location = 3, component = 2) in vec2 q;\nlayout(location = 1) in vec4 unread;\n"
     "void main() { gl_Position = vec4(m[2], 1.0) + vec4(p, q); }\n",
     color,
     Mesa::links,
     {}},
    {"sampler_on_an_element",
     "450",
     plain,
     "layout(binding = 0) uniform sampler2D maps[4];\nlayout(binding = 2) uniform sampler2D mask;\nout vec4 "
     "c;\n"
     "void main() { c = texture(maps[3], vec2(0.0)) + texture(mask, vec2(0.0)); }\n",
     Mesa::links,
     {"'sampler2D mask' and 'sampler2D maps' (tiny.frag:2) share texture unit 2"}},
    {"two_types_on_one_unit",
     "450",
     plain,
     "layout(binding = 1) uniform sampler2D map;\nlayout(binding = 1) uniform samplerCube sky;\nout vec4 c;\n"
     "void main() { c = texture(map, vec2(0.0)) + texture(sky, vec3(1.0)); }\n",
     Mesa::is_lax,
     {"share texture unit 1: OpenGL refuses to draw (INVALID_OPERATION)"}},
    {"unread_on_one_unit",
     "450",
     plain,
     "layout(binding = 1) uniform sampler2D map;\nlayout(binding = 1) uniform samplerCube sky;\nout vec4 c;\n"
     "void main() { c = texture(map, vec2(0.0)); }\n",
     Mesa::links,
     {}},
    {"counters_at_one_offset",
     "450",
     plain,
     "layout(binding = 0, offset = 4) uniform atomic_uint hits;\n"
     "layout(binding = 0) uniform atomic_uint misses;\nout vec4 c;\n"
     "void main() { c = vec4(atomicCounter(hits) + atomicCounter(misses)); }\n",
     Mesa::links,
     {}},
    {"counters_of_two_stages_at_one_offset",
     "450",
     "layout(binding = 0, offset = 0) uniform atomic_uint hits[2];\n"
     "void main() { gl_Position = vec4(atomicCounter(hits[1])); }\n",
     "layout(binding = 0, offset = 4) uniform atomic_uint misses;\nout vec4 c;\n"
     "void main() { c = vec4(atomicCounter(misses)); }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: the atomic counters 'misses' and 'hits' (tiny.vert:2) share offset 4 of binding "
      "0"}},
    {"unread_counter_at_one_offset",
     "450",
     plain,
     "layout(binding = 0, offset = 0) uniform atomic_uint hits;\nout vec4 c;\n"
     "void main() { c = vec4(atomicCounter(hits)); }\n",
     Mesa::links,
     {}},
    {"offsets_of_a_counter",
     "450",
     "layout(binding = 0, offset = 0) uniform atomic_uint hits;\nvoid main() { gl_Position = "
     "vec4(atomicCounter(hits)); }\n",
     "layout(binding = 0, offset = 4) uniform atomic_uint hits;\nout vec4 c;\n"
     "void main() { c = vec4(atomicCounter(hits)); }\n",
     Mesa::refuses,
     {"'hits' is at offset 4 here, but at 0 in tiny.vert:2"}},
    {"room_for_a_matrix",
     "450",
     "layout(location = 3) in vec4 a;\nlayout(location = 8) in vec4 b;\nin vec4 z;\nin mat4 m;\nin mat4 n;\n"
     "in mat3 k;\nvoid main() { gl_Position = a + b + z + m[0] + n[0] + k[0].xyzx; }\n",
     color,
     Mesa::links,
     {}},
    {"no_room_for_a_matrix",
     "330 core",
     "layout(location = 3) in vec4 a;\nlayout(location = 7) in vec4 b;\nlayout(location = 11) in vec4 c;\n"
     "layout(location = 15) in vec4 d;\nin mat4 m;\nvoid main() { gl_Position = a + b + c + d + m[0]; }\n",
     color,
     Mesa::refuses,
     {"tiny.vert:6: error: the vertex attribute 'm' takes 4 locations in a row, and no 4 in a row of the 16 "
      "that "
      "OpenGL guarantees are free (MAX_VERTEX_ATTRIBS)"}},
    {"no_room_for_an_unread_matrix",
     "330 core",
     "layout(location = 3) in vec4 a;\nlayout(location = 7) in vec4 b;\nlayout(location = 11) in vec4 c;\n"
     "layout(location = 15) in vec4 d;\nin mat4 m;\nvoid main() { gl_Position = a + b + c + d; }\n",
     color,
     Mesa::links,
     {}},
    {"no_room_for_an_array_of_outputs",
     "450",
     plain,
     "layout(location = 1) out vec4 a;\nlayout(location = 3) out vec4 b;\nlayout(location = 5) out vec4 c;\n"
     "layout(location = 7) out vec4 d;\nout vec4 m[2];\n"
     "void main() { a = b = c = d = m[0] = m[1] = vec4(1.0); }\n",
     Mesa::refuses,
     {"tiny.frag:6: error: the fragment output 'm' takes 2 locations in a row, and no 2 in a row of the 8"}},
    {"locations_of_a_sampler_and_a_uniform",
     "450",
     "layout(location = 1) uniform sampler2D maps[3];\nvoid main() { gl_Position = texture(maps[0], "
     "vec2(0.0)); }\n",
     "layout(location = 3) uniform vec4 tone;\nout vec4 c;\nvoid main() { c = tone; }\n",
     Mesa::refuses,
     {"the uniforms 'tone' and 'maps' (tiny.vert:2) share location 3"}},
};

const Row limits[] = {
    {"varying_location_14",
     "450",
     "layout(location = 14) out vec4 s;\nvoid main() { s = vec4(1.0); gl_Position = s; }\n",
     "layout(location = 14) in vec4 s;\nout vec4 c;\nvoid main() { c = s; }\n",
     Mesa::links,
     {}},
    {"varying_location_20",
     "450",
     "layout(location = 20) out vec4 s;\nvoid main() { s = vec4(1.0); gl_Position = s; }\n",
     "layout(location = 20) in vec4 s;\nout vec4 c;\nvoid main() { c = s; }\n",
     Mesa::is_lax,
     {"tiny.vert:2: error: locations of varyings up to the last of 's': 21, OpenGL guarantees only 15"}},
    {"attributes_of_matrices_located",
     "450",
     "layout(location = 0) in mat4 a;\nlayout(location = 13) in mat4 b;\nvoid main() { gl_Position = a[0] + "
     "b[3]; }\n",
     color,
     Mesa::refuses,
     {"tiny.vert:3: error: vertex attribute locations up to the last of 'b': 17, OpenGL guarantees only 16"}},
    {"attributes_of_matrices",
     "330 core",
     "in mat4 a, b, d, e, f;\nvoid main() { gl_Position = a[0] + b[0] + d[0] + e[0] + f[3]; }\n",
     color,
     Mesa::refuses,
     {"vertex attribute locations: 20, OpenGL guarantees only 16 (MAX_VERTEX_ATTRIBS)"}},
    {"unread_attributes",
     "330 core",
     "in mat4 a, b, d, e, f;\nvoid main() { gl_Position = a[0]; }\n",
     color,
     Mesa::links,
     {}},
    {"output_location_8",
     "450",
     plain,
     "layout(location = 0) out vec4 c;\nlayout(location = 8) out vec4 d;\nvoid main() { c = d = vec4(1.0); "
     "}\n",
     Mesa::refuses,
     {"tiny.frag:3: error: fragment output locations up to the last of 'd': 9"}},
    {"plain_uniforms",
     "450",
     plain,
     "uniform vec4 big[257];\nout vec4 c;\nvoid main() { c = big[256]; }\n",
     Mesa::links,
     {"tiny.frag:2: warning: components of plain uniforms in the fragment stage: 1028, OpenGL guarantees "
      "only "
      "1024"}},
    {"unread_uniforms",
     "450",
     plain,
     "uniform vec4 big[2000];\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::links,
     {}},
    {"unread_samplers",
     "330 core",
     plain,
     "uniform sampler2D maps[30];\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n",
     Mesa::links,
     {}},
    {"varyings_packed_es300",
     "300 es",
     "out vec2 a, b, d, e, f, g, h, i, j, k, l, m, n, o, p, q;\n"
     "void main() { a = b = d = e = f = g = h = i = j = k = l = m = n = o = p = q = vec2(1.0); "
     "gl_Position = vec4(0.0); }\n",
     "in vec2 a, b, d, e, f, g, h, i, j, k, l, m, n, o, p, q;\nout vec4 c;\n"
     "void main() { c = (a + b + d + e + f + g + h + i + j + k + l + m + n + o + p + q).xyxy; }\n",
     Mesa::links,
     {}},
    {"varyings_beyond_rows_es300",
     "300 es",
     "out vec3 v[16];\nvoid main() { for (int i = 0; i < 16; ++i) v[i] = vec3(1.0); gl_Position = vec4(0.0); "
     "}\n",
     "in vec3 v[16];\nout vec4 c;\nvoid main() { c = v[15].xyzx; }\n",
     Mesa::is_lax,
     {"varying vectors: 16, OpenGL guarantees only 15 (MAX_VARYING_VECTORS)"}},
    {"storage_blocks_16",
     "450",
     plain,
     "layout(std430, binding = 0) buffer A { float x; } a[8];\n"
     "layout(std430, binding = 0) buffer B { float x; } b[8];\nout vec4 c;\n"
     "void main() { c = vec4(a[0].x + a[1].x + a[2].x + a[3].x + a[4].x + a[5].x + a[6].x + a[7].x\n"
     "    + b[0].x + b[1].x + b[2].x + b[3].x + b[4].x + b[5].x + b[6].x + b[7].x); }\n",
     Mesa::links,
     {"share binding 0", "warning: storage blocks in the fragment stage: 16, OpenGL guarantees only 8"}},
    {"storage_blocks_17",
     "450",
     plain,
     "layout(std430, binding = 0) buffer A { float x; } a[8];\n"
     "layout(std430, binding = 0) buffer B { float x; } b[8];\n"
     "layout(std430, binding = 0) buffer C { float x; } d;\nout vec4 c;\n"
     "void main() { c = vec4(a[0].x + a[1].x + a[2].x + a[3].x + a[4].x + a[5].x + a[6].x + a[7].x\n"
     "    + b[0].x + b[1].x + b[2].x + b[3].x + b[4].x + b[5].x + b[6].x + b[7].x + d.x); }\n",
     Mesa::refuses,
     {"share binding 0", "share binding 0", "share binding 0",
      "error: storage blocks in the fragment stage: 17, OpenGL guarantees only 8 "
      "(MAX_FRAGMENT_SHADER_STORAGE_BLOCKS)"}},
};

const Row outputs[] = {
    {"output_never_written",
     "450",
     plain,
     "layout(location = 0) out vec4 c;\nvoid main() {}\n",
     Mesa::links,
     {"tiny.frag:2: warning: the fragment stage never writes its output 'c'"}},
    {"output_written_on_one_path",
     "450",
     "out float s;\nvoid main() { s = 1.0; gl_Position = vec4(0.0); }\n",
     "in float s;\nout vec4 c;\nvoid main() {\n    if (s > 0.5) c = vec4(1.0);\n}\n",
     Mesa::links,
     {"tiny.frag:3: warning: some paths through main() do not write 'c'"}},
    {"output_written_or_discarded",
     "450",
     "out float s;\nvoid main() { s = 1.0; gl_Position = vec4(0.0); }\n",
     "in float s;\nout vec4 c;\nvoid main() {\n    if (s > 0.5) discard;\n    c.rgb = vec3(1.0);\n}\n",
     Mesa::links,
     {}},
    {"output_written_in_both_branches",
     "450",
     "out float s;\nvoid main() { s = 1.0; gl_Position = vec4(0.0); }\n",
     "in float s;\nout vec4 c;\nvoid set(float x) { c = vec4(x); }\nvoid main() {\n"
     "    if (s > 0.5) { set(1.0); return; }\n    for (int i = 0; i < 3; ++i) if (s > float(i)) break;\n"
     "    switch (int(s)) { case 0: c = vec4(0.0); break; default: set(0.5); }\n}\n",
     Mesa::links,
     {}},
    {"position_never_written",
     "450",
     "out vec3 s;\nvoid main() { s = vec3(1.0); }\n",
     "in vec3 s;\nout vec4 c;\nvoid main() { c = s.xyzx; }\n",
     Mesa::links,
     {"tiny.vert: warning: the vertex stage never writes gl_Position"}},
    {"position_on_one_path",
     "450",
     "in float s;\nvoid main() { if (s > 0.0) gl_Position = vec4(0.0); }\n",
     color,
     Mesa::links,
     {"tiny.vert:3: warning: some paths through main() do not write gl_Position"}},
    {"early_tests_and_depth",
     "450",
     plain,
     "layout(early_fragment_tests) in;\nout vec4 c;\nvoid main() {\n    c = vec4(1.0);\n    gl_FragDepth = "
     "0.5;\n}\n",
     Mesa::links,
     {"tiny.frag:6: warning: what is written to gl_FragDepth is ignored: tiny.frag:2 states "
      "early_fragment_tests"}},
    {"early_tests_and_discard",
     "450",
     "out float s;\nvoid main() { s = 1.0; gl_Position = vec4(0.0); }\n",
     "layout(early_fragment_tests) in;\nin float s;\nout vec4 c;\nvoid main() {\n    if (s > 0.0) discard;\n"
     "    c = vec4(1.0);\n}\n",
     Mesa::links,
     {"tiny.frag:6: warning: discard comes too late for the depth buffer: tiny.frag:2 states"}},
    {"depth_less_without_its_extension",
     "330 core",
     plain,
     "layout(depth_less) out float gl_FragDepth;\nout vec4 c;\nvoid main() { c = vec4(1.0); gl_FragDepth = "
     "0.0; }\n",
     Mesa::refuses,
     {"GL_ARB_conservative_depth"}},
};

constexpr auto name_of_row = [](const auto& row) { return std::string(row.param.name); };
const Row language[] = {
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
     {"tiny.frag:3: error: elements of gl_SampleMask up to the last: 2, OpenGL guarantees only 1 "
      "(MAX_SAMPLE_MASK_WORDS)"}},
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
    {"offset_in_a_block_without_layout",
     "450",
     plain,
     "uniform B { layout(offset = 16) vec4 a; };\nout vec4 c;\nvoid main() { c = a; }\n",
     Mesa::refuses,
     {"tiny.frag:2: error: 'offset' in the block 'B', which states neither std140 nor std430"}},
    {"offset_in_a_block_with_a_default_layout",
     "450",
     plain,
     "layout(std140) uniform;\nuniform B { layout(offset = 16) vec4 a; };\nout vec4 c;\n"
     "void main() { c = a; }\n",
     Mesa::links,
     {}},
};

INSTANTIATE_TEST_SUITE_P(Language, LinkRule, testing::ValuesIn(language), name_of_row);
INSTANTIATE_TEST_SUITE_P(Varyings, LinkRule, testing::ValuesIn(varyings), name_of_row);
INSTANTIATE_TEST_SUITE_P(Names, LinkRule, testing::ValuesIn(names), name_of_row);
INSTANTIATE_TEST_SUITE_P(Places, LinkRule, testing::ValuesIn(places), name_of_row);
INSTANTIATE_TEST_SUITE_P(Limits, LinkRule, testing::ValuesIn(limits), name_of_row);
INSTANTIATE_TEST_SUITE_P(Outputs, LinkRule, testing::ValuesIn(outputs), name_of_row);

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
