// That what glslang checks is what a driver gets: both take, or refuse, every text that composing makes.
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/key.hpp"
#include "lab/render/program.hpp"
#include "small_families.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

constexpr const char* vertex =
    "#version 330 core\nlayout(location = 0) in vec3 position;\n"
    "void main() { gl_Position = vec4(position, 1.0); }\n";

struct DriverRow {
    const char* name;
    const char* fragment;  ///< without its #version 330 core and the output `color`
    const char* included;  ///< a.glsl
    const char* mistake;   ///< where both see one; empty: both take it
    Comments comments = Comments::remove;
};

class Driver : public testing::TestWithParam<DriverRow> {};

/// "path:line" of the first error.
std::string place_of(const Diagnostics& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics)
        if (diagnostic.severity == Severity::error)
            return diagnostic.place.file + ":" + std::to_string(diagnostic.place.line);
    return "";
}

TEST_P(Driver, AgreesWithGlslang) {
    const MemoryFileSystem files({{"tiny.vert", vertex},
                                  {"tiny.frag", std::string("#version 330 core\n") + GetParam().fragment},
                                  {"a.glsl", GetParam().included}});
    SearchPath search;
    search.add(files, "", "", false);
    const Family family = family_of("");
    const Composition composition =
        compose(family, {Key()}, search, Dialect::own, GetParam().comments).value();
    EXPECT_EQ(place_of(validate(family, composition, {}).diagnostics), GetParam().mistake);

    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << first_text(context.error());
    const Result<Program> program =
        link_program(*context, stages_of(composition, composition.permutations.front()));
    EXPECT_EQ(program ? "" : place_of(program.error()), GetParam().mistake);
}

TEST(DriverItself, JoinsLinesInEveryVersion) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << first_text(context.error());
    for (const char* version : {"150", "330 core", "450 core"}) {
        const std::string fragment = std::string("#version ") + version +
                                     "\nout vec4 color;\n// takes in \\\nconst float a = 1.0;\n"
                                     "void main() { color = vec4(a); }\n";
        const std::vector<StageText> stages = {stage_text(StageKind::vertex, "a.vert", vertex),
                                               stage_text(StageKind::fragment, "a.frag", fragment)};
        EXPECT_FALSE(link_program(*context, stages)) << version;
    }
}

struct FamilyRow {
    const char* name;
    const char* body;  ///< of tiny.toml, behind its first three lines
    const char* key;
    const char* vertex;
    const char* fragment;
    const char* mistake;  ///< where both see one; empty: both take it
    bool is_lax = false;  ///< the driver takes it all the same
};

class FamilyInTheDriver : public testing::TestWithParam<FamilyRow> {};

TEST_P(FamilyInTheDriver, IsAsGlslangSays) {
    const FamilyRow& row = GetParam();
    const MemoryFileSystem files({{"tiny.vert", row.vertex}, {"tiny.frag", row.fragment}});
    const DiskFileSystem disk;
    SearchPath search;
    search.add(files, "", "", false);
    search.add(disk, GOBO_SOURCE_DIR "/templates", "templates/", false);
    const Family family = family_of(row.body);
    const Composition composition =
        compose(family, {parse_key(family, row.key).value()}, search, Dialect::own).value();
    EXPECT_EQ(place_of(validate(family, composition, {}).diagnostics), row.mistake);

    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << first_text(context.error());
    const Result<Program> program =
        link_program(*context, stages_of(composition, composition.permutations.front()));
    const std::string place = program ? "" : place_of(program.error());
    if (place == ":0")  // Mesa names no line of an #error
        EXPECT_STRNE(row.mistake, "");
    else
        EXPECT_EQ(place, row.is_lax ? "" : row.mistake);
}

constexpr const char* core_vertex = "in vec3 position;\nvoid main() { gl_Position = vec4(position, 1.0); }\n";
constexpr const char* es_fragment =
    "version = \"300 es\"\n[prologue]\nfragment = \"precision highp float;\"\n";

INSTANTIATE_TEST_SUITE_P(
    Rows, FamilyInTheDriver,
    testing::Values(
        FamilyRow{"version_and_prologue",
                  "version = \"330 core\"\n[prologue]\nfragment = '''\nout vec4 color;\nconst float shade = "
                  "0.5;\n'''\n",
                  "default", core_vertex, "void main() { color = vec4(shade); }\n", ""},
        FamilyRow{
            "version_of_the_other_stage", "", "default",
            "#version 330 core\nin vec3 position;\nvoid main() { gl_Position = vec4(position, 1.0); }\n",
            "out vec4 color;\n#if __VERSION__ != 330\nbroken\n#endif\nvoid main() { color = vec4(1.0); }\n",
            ""},
        FamilyRow{"count_of_one_number",
                  "version = \"330 core\"\n[features.n]\ncount = [3, 3]\nconstant = \"N\"\n", "default",
                  core_vertex,
                  "out vec4 color;\nvoid main() { float a[N]; a[2] = 1.0; color = vec4(a[2]); }\n", ""},
        FamilyRow{"program_called_2d",
                  "version = \"330 core\"\n[programs.2d]\nvertex = \"tiny.vert\"\nfragment = \"tiny.frag\"\n",
                  "program=2d", core_vertex, "out vec4 color;\nvoid main() { color = vec4(1.0); }\n", ""},
        FamilyRow{"include_rule_of_one_file",
                  "version = \"330 core\"\n[includes]\n'#pragma color' = "
                  "'tiny.vert'\n[features.part]\ndefine = \"PART\"\n",
                  "default",
                  "#ifdef ONLY_A_NAME\n#endif\nin vec3 position;\nvoid main() { gl_Position = vec4(position, "
                  "1.0); }\n",
                  "#pragma color\nout vec4 color;\nvoid main() { color = vec4(1.0); }\n", "tiny.vert:4"},
        FamilyRow{
            "mistake_in_the_prologue",
            "version = \"330 core\"\n[prologue]\nfragment = '''\n\nout vec4 color;\nconst float shade = "
            "oops;\n'''\n",
            "default", core_vertex, "void main() { color = vec4(shade); }\n", "tiny.toml:9"},
        FamilyRow{"mistake_behind_the_prologue",
                  "version = \"330 core\"\n[prologue]\nfragment = '''\n\nout vec4 color;\n'''\n", "default",
                  core_vertex, "void main() { color = vec4(oops); }\n", "tiny.frag:1"},
        FamilyRow{"macro_with_text",
                  "version = \"330 core\"\n[features.half]\ndefine = \"HALF\"\ntext = \"vec2(0.5)\"\n",
                  "half=on", core_vertex, "out vec4 color;\nvoid main() { color = vec4(HALF, HALF); }\n", ""},
        FamilyRow{"macro_that_is_empty",
                  "version = \"330 core\"\n[features.half]\ndefine = \"HALF\"\ntext = \"\"\n", "half=on",
                  core_vertex, "out vec4 color;\n#ifdef HALF\nvoid main() { color = vec4(1); }\n#endif\n",
                  ""},
        FamilyRow{"unrolled_samplers",
                  "version = \"300 es\"\nunroll_loops = true\n[prologue]\nfragment = \"precision highp "
                  "float;\"\n[features.maps]\ncount = [0, 3]\nconstant = \"MAPS\"\n",
                  "maps=3", core_vertex,
                  "uniform sampler2D maps[MAPS];\nout vec4 color;\nvoid main() {\n    color = vec4(0);\n"
                  "#pragma unroll_loop_start\nfor (int i = 0; i < MAPS; i ++) {\n"
                  "    color += texture(maps[i], vec2(UNROLLED_LOOP_INDEX));\n}\n"
                  "#pragma unroll_loop_end\n}\n",
                  ""},
        FamilyRow{"mistake_behind_an_unrolled_loop", "version = \"330 core\"\nunroll_loops = true\n",
                  "default", core_vertex,
                  "out vec4 color;\nvoid main() {\n    color = vec4(0);\n"
                  "#pragma unroll_loop_start\nfor (int i = 0; i < 3; i ++) {\n    color += 1.0;\n}\n"
                  "#pragma unroll_loop_end\n    oops;\n}\n",
                  "tiny.frag:9"},
        FamilyRow{"mistake_in_an_unrolled_loop", "version = \"330 core\"\nunroll_loops = true\n", "default",
                  core_vertex,
                  "out vec4 color;\nvoid main() {\n    color = vec4(0);\n"
                  "#pragma unroll_loop_start\nfor (int i = 0; i < 3; i ++) {\n    color += oops;\n}\n"
                  "#pragma unroll_loop_end\n}\n",
                  "tiny.frag:6"},
        FamilyRow{"function_that_a_later_version_has", es_fragment, "default", core_vertex,
                  "uniform vec3 tint;\nout vec4 color;\nfloat average(const in vec3 v) { return dot(v, "
                  "vec3(0.33)); }\nfloat fma(float a) { return a; }\nint findLSB(int a) { return a + 1; }\n"
                  "void main() { color = vec4(average(tint), fma(1.0), float(findLSB(2)), 1.0); }\n",
                  ""},
        FamilyRow{"function_that_the_version_has", es_fragment, "default", core_vertex,
                  "out vec4 color;\nfloat mix(float a, float b, float c) { return a; }\n"
                  "void main() { color = vec4(mix(1.0, 2.0, 3.0)); }\n",
                  "tiny.frag:2"},
        FamilyRow{"legacy", "version = \"150\"\ncompatibility = true\n", "default",
                  "void main() {\n    vec3 normal = normalize(gl_NormalMatrix * gl_Normal);\n"
                  "    gl_FrontColor = gl_Color * gl_LightSource[0].diffuse *\n"
                  "                    max(dot(normal, gl_LightSource[0].position.xyz), 0.0);\n"
                  "    gl_TexCoord[0] = gl_TextureMatrix[0] * gl_MultiTexCoord0;\n"
                  "    gl_Position = ftransform();\n}\n",
                  "uniform sampler2D map;\nuniform sampler2DShadow shadow;\nvarying vec4 unread;\n"
                  "void main() {\n    gl_FragColor = gl_Color * texture2D(map, gl_TexCoord[0].xy) *\n"
                  "                   shadow2D(shadow, gl_TexCoord[0].xyz).r * gl_FrontMaterial.shininess;\n"
                  "}\n",
                  ""},
        FamilyRow{"legacy_array_sized_again", "version = \"150\"\ncompatibility = true\n", "default",
                  "varying vec4 gl_TexCoord[2];\n"
                  "void main() { gl_TexCoord[1] = gl_MultiTexCoord4; gl_Position = ftransform(); }\n",
                  "in vec4\n  gl_TexCoord [2] ;\nvoid main() { gl_FragColor = gl_TexCoord[1]; }\n", ""},
        FamilyRow{"legacy_beside_a_variable_called_texture", "version = \"150\"\ncompatibility = true\n",
                  "default", "void main() { gl_BackColor = gl_Color; gl_Position = ftransform(); }\n",
                  "uniform sampler2D texture;\n"
                  "void main() { gl_FragColor = texture2D(texture, vec2(0.5), 1.0); }\n",
                  ""},
        FamilyRow{"legacy_before_its_precision", "version = \"300 es\"\ncompatibility = true\n", "default",
                  "attribute vec3 position;\nvarying vec2 uv;\n"
                  "void main() { uv = position.xy; gl_Position = vec4(position, 1.0); }\n",
                  "precision mediump float;\nvarying vec2 uv;\nuniform sampler2D map;\n"
                  "void main() { gl_FragColor = texture2D(map, uv) + texture2DLodEXT(map, uv, 1.0); }\n",
                  ""},
        FamilyRow{"legacy_point_and_clip_planes", "version = \"330 core\"\ncompatibility = true\n", "default",
                  "void main() { gl_PointSize = gl_Point.size; gl_ClipDistance[0] = dot(gl_ClipPlane[0], "
                  "gl_Vertex); gl_Position = ftransform(); }\n",
                  "void main() { gl_FragColor = vec4(1.0); }\n", ""},
        FamilyRow{"legacy_clip_vertex", "version = \"330 core\"\ncompatibility = true\n", "default",
                  "void main() { gl_ClipVertex = gl_Vertex; gl_Position = ftransform(); }\n",
                  "void main() { gl_FragColor = vec4(1.0); }\n", "tiny.vert:1"},
        FamilyRow{"legacy_array_read_beyond_what_is_written", "version = \"150\"\ncompatibility = true\n",
                  "default",
                  "void main() { gl_TexCoord[0] = gl_MultiTexCoord0; gl_Position = ftransform(); }\n",
                  "void main() { gl_FragColor = gl_TexCoord[1]; }\n", ""},
        FamilyRow{"legacy_color_that_the_vertex_stage_lacks", "version = \"150\"\ncompatibility = true\n",
                  "default", "void main() { gl_Position = ftransform(); }\n",
                  "void main() { gl_FragColor = gl_Color; }\n", "tiny.frag:1", true},
        FamilyRow{"legacy_coordinates_that_the_vertex_stage_lacks",
                  "version = \"150\"\ncompatibility = true\n", "default",
                  "void main() { gl_Position = ftransform(); }\n",
                  "void main() { gl_FragColor = gl_TexCoord[0]; }\n", "tiny.frag:1", true},
        FamilyRow{"mistake_in_legacy", "version = \"150\"\ncompatibility = true\n", "default",
                  "\nvoid main() { gl_Position = ftransform(); oops; }\n",
                  "void main() { gl_FragColor = vec4(1.0); }\n", "tiny.vert:2"}),
    [](const auto& row) { return row.param.name; });

constexpr const char* plain_main =
    "#include \"a.glsl\"\nout vec4 color;\nvoid main() { color = vec4(one()); }\n";

INSTANTIATE_TEST_SUITE_P(
    Rows, Driver,
    testing::Values(
        DriverRow{"unix_line_ends", plain_main, "// one\nfloat one() { return 1.0; }\n", ""},
        DriverRow{"windows_line_ends", plain_main,
                  "// one\r\n#define A \\\r\n1.0\r\nfloat one() { return A; }\r\n", ""},
        DriverRow{"old_line_ends", plain_main, "// one\r#define A 1.0\rfloat one() { return A; }\r", ""},
        DriverRow{"mistake_behind_old_line_ends", plain_main, "// one\r\rfloat one() { return oops; }\r",
                  "a.glsl:3"},
        DriverRow{"byte_order_mark", plain_main, "\xEF\xBB\xBF#define A 1.0\nfloat one() { return A; }", ""},
        DriverRow{"form_feed", plain_main, "float one()\f{\vreturn 1.0; }", ""},
        DriverRow{"comment_that_takes_in_a_declaration", plain_main,
                  "float one() {\n// C:\\art\\\nfloat a = 1.0;\nreturn a;\n}\n", "a.glsl:4"},
        DriverRow{"comment_kept_to_its_line", plain_main,
                  "float one() {\n// C:\\art\\ \nfloat a = 1.0;\nreturn a;\n}\n", ""},
        DriverRow{"comment_kept_to_its_line_and_shipped", plain_main,
                  "float one() {\n// C:\\art\\ \nfloat a = 1.0;\nreturn a;\n}\n", "", Comments::keep},
        DriverRow{"comment_that_takes_in_a_declaration_and_is_shipped", plain_main,
                  "float one() {\n// C:\\art\\\nfloat a = 1.0;\nreturn a;\n}\n", "a.glsl:4", Comments::keep},
        DriverRow{"comment_in_quotation_marks", plain_main,
                  "#if 0\n#error \"see // http\"\n#endif\nfloat one() { return 1.0; }\n", ""},
        DriverRow{"comment_in_quotation_marks_and_shipped", plain_main,
                  "#if 0\n#error \"see // http\"\n#endif\nfloat one() { return 1.0; }\n", "", Comments::keep},
        DriverRow{"pragma_with_a_comment_in_quotation_marks", plain_main,
                  "#pragma note(\"see // http\")\nfloat one() { return 1.0; }\n", ""},
        DriverRow{"comment_amid_a_directive", plain_main,
                  "#define A /* of\nno\nuse */ 1.0\nfloat one() { return A; }\n", ""},
        DriverRow{"mistake_behind_a_comment_amid_a_directive", plain_main,
                  "#define A /* of\nno\nuse */ 1.0\nfloat one() { return oops; }\n", "a.glsl:4"},
        DriverRow{"joined_macro", plain_main,
                  "#define SUM(a, b) \\\n ((a) + \\\n  (b))\nfloat one() { return SUM(0.5, 0.5); }\n", ""},
        DriverRow{"mistake_behind_a_joined_macro", plain_main,
                  "#define SUM(a, b) \\\n ((a) + \\\n  (b))\n\nfloat one() { return oops; }\n", "a.glsl:5"},
        DriverRow{"joined_at_the_end", plain_main, "float one() { return 1.0; } \\", ""},
        DriverRow{"comment_at_the_end", plain_main, "float one() { return 1.0; } // \\", ""},
        DriverRow{"extension_behind_code", plain_main,
                  "float aHalf() { return 0.5; }\n#extension GL_ARB_texture_gather : require\nuniform "
                  "sampler2D map;\n"
                  "float one() { return textureGather(map, vec2(0.5)).x; }\n",
                  ""},
        DriverRow{"extension_where_there_is_one", plain_main,
                  "#ifdef GL_ARB_texture_gather\n#extension GL_ARB_texture_gather : require\n#endif\n"
                  "uniform sampler2D map;\nfloat one() { return textureGather(map, vec2(0.5)).x; }\n",
                  ""},
        DriverRow{"extension_under_a_dead_condition", plain_main,
                  "#if 0\n#extension GL_no_such : require\n#endif\nfloat one() { return 1.0; }\n", ""},
        DriverRow{"line_directive", plain_main, "#line 100\n#line 200 3\nfloat one() { return 1.0; }\n", ""},
        DriverRow{"mistake_behind_a_line_directive", plain_main, "#line 100\nfloat one() { return oops; }\n",
                  "a.glsl:2"},
        DriverRow{"version_in_an_include", plain_main, "\n#version 150\nfloat one() { return 1.0; }\n", ""},
        DriverRow{"pragma_once", plain_main, "#pragma once\nfloat one() { return 1.0; }\n", ""},
        DriverRow{"include_below_code",
                  "out vec4 color;\nfloat two() { return 2.0; }\n#include \"a.glsl\"\nvoid main() { color = "
                  "vec4(one()); }\n",
                  "float one() { return 0.5 * two(); }\n", ""},
        DriverRow{"include_within_a_function",
                  "out vec4 color;\nvoid main() {\nfloat a = 0.0;\n#include \"a.glsl\"\n#include "
                  "\"a.glsl\"\ncolor = vec4(a);\n}\n",
                  "a += 0.5;\n", ""},
        DriverRow{
            "mistake_in_an_include_within_a_function",
            "out vec4 color;\nvoid main() {\nfloat a = 0.0;\n#include \"a.glsl\"\ncolor = vec4(a);\n}\n",
            "\na += oops;\n", "a.glsl:2"},
        DriverRow{
            "mistake_behind_an_include",
            "out vec4 color;\nvoid main() {\nfloat a = 0.0;\n#include \"a.glsl\"\ncolor = vec4(oops);\n}\n",
            "a += 0.5;\n", "tiny.frag:6"},
        DriverRow{"include_under_a_condition",
                  "#if __VERSION__ >= 330\n#include \"a.glsl\"\n#else\n#include \"none.glsl\"\n#endif\nout "
                  "vec4 color;\n"
                  "void main() { color = vec4(one()); }\n",
                  "float one() { return 1.0; }\n", ""},
        DriverRow{"include_twice_with_a_guard",
                  "#define USED\n#include \"a.glsl\"\n#include \"a.glsl\"\nout vec4 color;\nvoid main() { "
                  "color = vec4(one()); }\n",
                  "#ifndef A_\n#define A_\nfloat one() { return 1.0; }\n#endif\n", ""},
        DriverRow{"include_twice_without",
                  "#define USED\n#include \"a.glsl\"\n#include \"a.glsl\"\nout vec4 color;\nvoid main() { "
                  "color = vec4(one()); }\n",
                  "float one() { return 1.0; }\n", "a.glsl:1"}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
