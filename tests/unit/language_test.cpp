// What glslang and drivers take of GLSL's language: whether gobo accepts a text, Mesa links what gobo ships
// of it.
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/read_family.hpp"
#include "lab/render/program.hpp"
#include "link_row.hpp"
#include "small_families.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct Row {
    const char* name;
    const char* version;
    const char* fragment;  ///< its output is called `c`
    const char* message;   ///< of the error that gobo gives, in part; empty where both take it
};

void PrintTo(const Row& row, std::ostream* stream) {
    *stream << row.name;
}

class Language : public testing::TestWithParam<Row> {};

TEST_P(Language, IsTakenAsMesaTakesIt) {
    const Row& row = GetParam();
    const std::string head = fmt::format("#version {}\n", row.version);
    const std::string precision = head.ends_with("es\n") ? "precision highp float;\n" : "";
    const MemoryFileSystem files({{"tiny.vert", head + "void main() { gl_Position = vec4(0.0); }\n"},
                                  {"tiny.frag", head + precision + row.fragment}});
    SearchPath search;
    search.add(files, "", "", false);
    const Family family = family_of("");
    const Result<Composition> composition = compose(family, {{}}, search, Dialect::own);
    ASSERT_TRUE(composition) << first_text(composition.error());
    const Diagnostics found = validate(family, *composition, {}).diagnostics;
    std::string errors;
    for (const Diagnostic& diagnostic : found)
        if (diagnostic.severity == Severity::error) errors += to_text(diagnostic);
    EXPECT_EQ(exit_status(found), *row.message == '\0' ? 0 : 1) << errors;
    EXPECT_THAT(errors, testing::HasSubstr(row.message));

    if (head.ends_with("compatibility\n")) return;  // of which Mesa makes no context here
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context);
    const Result<Program> program =
        link_program(*context, stages_of(*composition, composition->permutations.front()));
    EXPECT_EQ(program.has_value(), *row.message == '\0')
        << (program ? "it links" : first_text(program.error()));
}

constexpr const char* kOut = "out vec4 c;\n";

std::string with_main(const std::string& text, const std::string& value = "1.0") {
    return text + kOut + "void main() { c = vec4(" + value + "); }\n";
}

/// Texts live as long as the rows.
const char* keep(const std::string& text) {
    static std::vector<std::unique_ptr<std::string>> kept;
    return kept.emplace_back(std::make_unique<std::string>(text))->c_str();
}

Row row(const char* name, const char* version, const std::string& text, const char* message) {
    return {name, version, keep(text), message};
}

/// A text in which a condition that holds to drivers chooses what can be compiled, and what cannot be if not.
std::string branch(const std::string& condition, const std::string& color = "gl_FragColor") {
    return fmt::format("#if {}\n{}void main() {{ {} = vec4(float(__VERSION__)); }}\n#else\nbroken\n#endif\n",
                       condition, color == "c" ? "out mediump vec4 c;\n" : "", color);
}

const Row refused[] = {
    row("pragma_within_a_function", "450",
        kOut + std::string("void main() {\n#pragma optimize(off)\nc = vec4(1.0);\n}\n"),
        "tiny.frag:4: error: #pragma optimize stands within a function"),
    row("pragma_within_a_declaration", "330 core", with_main("const float q =\n#pragma debug(off)\n1.0;\n"),
        "tiny.frag:3: error: #pragma debug stands within a declaration"),
    row("pragma_before_a_body", "120",
        "float f()\n#pragma optimize(on)\n{ return 1.0; }\nvoid main() { gl_FragColor = vec4(f()); }\n",
        "tiny.frag:3: error: #pragma optimize stands within a declaration"),
    row("parameter_of_two_directions", "450", with_main("void f(float b, in out float a) { a = b; }\n"),
        "tiny.frag:2: error: a parameter of the function 'f' is both 'in' and 'out'"),
    row("two_precisions", "330 core", with_main("uniform highp mediump float q;\n"),
        "tiny.frag:2: error: 'mediump' stands behind 'highp'"),
    row("array_of_structs_of_samplers_returned", "330 core",
        with_main("struct Map { sampler2D map; };\nMap[2] f();\n"),
        "tiny.frag:3: error: the function 'f' returns 'Map', which holds a sampler or an image"),
    row("image_returned", "450", with_main("image2D f();\n"),
        "tiny.frag:2: error: the function 'f' returns 'image2D', which is a sampler or an image"),
    row("image_in_a_struct", "450", with_main("struct S {\n  uimage2D i;\n};\n"),
        "tiny.frag:3: error: the struct 'S' holds 'i' of type uimage2D"),
    row("function_of_a_reserved_name", "450", with_main("float gl_f();\n"),
        "tiny.frag:2: error: the function 'gl_f' begins with gl_, as GLSL's own names do"),
    row("member_of_a_reserved_name", "300 es", with_main("struct S { float gl_a; };\n"),
        "tiny.frag:3: error: the member 'gl_a' begins with gl_, as GLSL's own names do"),
    row("layout_behind_out", "330 core", "out layout(location = 0) vec4 c;\nvoid main() { c = vec4(1.0); }\n",
        "tiny.frag:2: error: 'out' stands before 'layout', which came with GLSL 4.20"),
    row("layout_of_a_parameter", "150",
        with_main("vec4 f(layout(pixel_center_integer) in float a) { return vec4(a); }\n"),
        "tiny.frag:2: error: a parameter of the function 'f' states a layout"),
    row("struct_of_samplers_given_out", "450",
        with_main("struct Map { vec2 at; sampler2D map; };\nstruct Maps { Map maps[2]; };\nvoid f(inout Maps "
                  "maps) {}\n"),
        "tiny.frag:4: error: the function 'f' has 'Maps' as inout, which holds a sampler or an image"),
    row("struct_of_samplers_returned", "450",
        with_main("struct Map { vec2 at; sampler2D map; };\nuniform Map map;\nMap f() { return map; }\n"),
        "tiny.frag:4: error: the function 'f' returns 'Map', which holds a sampler or an image"),
    row("struct_of_a_reserved_name", "300 es", with_main("struct gl_Mine { vec4 a; };\n"),
        "tiny.frag:3: error: the struct 'gl_Mine' begins with gl_, as GLSL's own names do"),
    row("blocks_of_no_number", "450", with_main("layout(std140) uniform B { vec4 a; } b[];\n", "b[0].a.x"),
        "tiny.frag:2: error: the array of blocks 'b' has no size"),
    row("member_of_a_shared_layout", "300 es",
        with_main("layout(std140) uniform B {\n  layout(shared) vec4 a;\n};\n"),
        "tiny.frag:4: error: a member of a block cannot state 'shared'"),
    row("varying_in_a_block", "150", with_main("in B { varying vec4 a; };\n"),
        "tiny.frag:2: error: a member of a block cannot be 'varying'"),
    row("location_twice", "330 core",
        "layout(location = 0, location = 0) out vec4 c;\nvoid main() { c = vec4(1.0); }\n",
        "tiny.frag:2: error: layout states 'location' twice"),
    row("layout_behind_a_layout", "300 es",
        "layout(location = 0) layout(location = 0) out vec4 c;\nvoid main() { c = vec4(1.0); }\n",
        "tiny.frag:3: error: one layout stands behind another, which came with GLSL ES 3.10"),
    row("int_returned_as_float", "330 core", with_main("float f() { return 1; }\n", "f()"),
        "tiny.frag:2: error: 'return' of another type than the function's: GLSL converts it from 4.20 on"),
    row("layout_of_a_varying", "120",
        "#extension GL_ARB_explicit_attrib_location : enable\n#extension GL_ARB_separate_shader_objects : "
        "enable\nlayout(location = 0) varying vec3 a;\nvoid main() { gl_FragColor = a.xyzx; }\n",
        "tiny.frag:4: error: layout() stands before 'varying', which takes none"),
    row("void_beside_other_parameters", "450", with_main("float f(void, int a) { return 1.0; }\n"),
        "tiny.frag:2: error: 'void' stands beside other parameters of 'f'"),
    row("macro_makes_a_string", "450", with_main("#define S(x) #x\n"),
        kNewerGlslang ? "tiny.frag:2: error: '#' : (#) can be preceded in its line only by spaces"
                      : "tiny.frag:2: error: the macro 'S' makes a string by '#', which GLSL has not"),
    row("macro_of_a_hash", "300 es", with_main("#define S #\n"), "the macro 'S' makes a string"),
    row("align_before_440", "430",
        with_main("layout(std140) uniform B { vec4 a; layout(align = 32) vec4 b; };\n"),
        "tiny.frag:2: error: layout(align) came with GLSL 4.40"),
    row("align_of_a_block", "330 core", with_main("layout(std140, align = 32) uniform B { vec4 a; };\n"),
        "help: state #version 440, or #extension GL_ARB_enhanced_layouts : require"),
    row("offset_before_420", "330 core",
        with_main("layout(std140) uniform B { layout(offset = 16) vec4 b; };\n"),
        "layout(offset) came with GLSL 4.40"),
    row("align_in_es", "310 es", with_main("layout(std140, align = 32) uniform B { vec4 a; };\n"),
        "GLSL ES has no layout(align)"),
    row("descriptor_set", "450", with_main("layout(set = 0, binding = 1) uniform sampler2D map;\n"),
        "OpenGL's GLSL has no layout(set): it is Vulkan's"),
    row("vulkan_extension", "450", with_main("#extension GL_EXT_nonuniform_qualifier : require\n"),
        "tiny.frag:2:1: error: no OpenGL has GL_EXT_nonuniform_qualifier: it is Vulkan's"),
    row("extension_of_es", "330 core", with_main("#extension GL_OES_standard_derivatives : require\n"),
        "no OpenGL has GL_OES_standard_derivatives: it is OpenGL ES's"),
    row("extension_of_the_desktop", "310 es", with_main("#extension GL_ARB_gpu_shader5 : require\n"),
        "no OpenGL ES has GL_ARB_gpu_shader5: it is OpenGL's"),
    row("extension_of_old_desktops", "310 es", with_main("#extension GL_EXT_texture_array : require\n"),
        "no OpenGL ES has GL_EXT_texture_array: it is OpenGL's"),
    row("extension_of_the_desktop_by_amd", "310 es",
        with_main("#extension GL_AMD_conservative_depth : require\n"),
        "no OpenGL ES has GL_AMD_conservative_depth: it is OpenGL's"),
    row("constant_of_images", "330 core", with_main("", "gl_MaxImageUnits"),
        "'gl_MaxImageUnits' came with GLSL 4.20"),
    row("constant_that_went", "450", with_main("", "gl_MaxTextureUnits"),
        "'gl_MaxTextureUnits' went with GLSL 1.40"),
    row("packed_double", "330 core", with_main("", "packDouble2x32(uvec2(1u))"),
        "'packDouble2x32' came with GLSL 4.00"),
    row("invariant_all", "450", with_main("#pragma STDGL invariant(all)\n"),
        "a fragment stage cannot state #pragma STDGL invariant(all)"),
    row("function_in_a_function", "450",
        "out vec4 c;\nvoid main() {\n    float f(float x);\n    c = vec4(1.0);\n}\n",
        "tiny.frag:4: error: the function 'f' is declared within another"),
    row("precision_before_const", "330 core", with_main("highp const float g = 1.0;\n", "g"),
        "'highp' stands before 'const', which came with GLSL 4.20"),
    row("precision_of_a_bool", "450", with_main("highp bool b = true;\n"), "'highp' before bool"),
    row("precision_of_a_double", "450", with_main("mediump dvec3 d = dvec3(1.0);\n"),
        "'mediump' before dvec3"),
    row("lone_in", "450", with_main("in;\n"), "tiny.frag:2: error: 'in;' declares nothing"),
    row("lone_uniform", "330 core", with_main("uniform;\n"), "'uniform;' declares nothing"),
    row("case_of_uint", "300 es",
        "out vec4 c;\nvoid main() {\n    c = vec4(1.0);\n    int i = 1;\n    switch (i) {\n"
        "    case 0u: break;\n    }\n}\n",
        "tiny.frag:8: error: a case of uint in a switch of int"),
    row("counter_without_binding", "430", with_main("uniform atomic_uint hits;\n"),
        "the atomic counter 'hits' states no binding"),
    row("unsized_amid", "430", with_main("layout(std430) buffer B { vec4 a[]; vec4 b; };\n"),
        "only the last member of a buffer block may be an array without a size"),
    row("instance_in_140", "140", with_main("layout(std140) uniform B { vec4 a; } b;\n"),
        "the block's name for its instance, 'b', came with GLSL 1.50"),
    row("index_in_es", "310 es",
        "layout(location = 0, index = 1) out vec4 c;\nvoid main() { c = vec4(1.0); }\n",
        "GLSL ES has no layout(index)"),
    row("number_of_samples_in_330", "330 core", with_main("", "float(gl_NumSamples)"),
        "'gl_NumSamples' : undeclared"),
    row("flat_of_no_interface", "330 core", with_main("flat vec3 v;\n"),
        "tiny.frag:2: error: 'flat' stands before what is neither an input nor an output"),
    row("own_version", "450", with_main("#define __VERSION__ 330\n"), "'__VERSION__' is GLSL's own"),
    row("function_in_a_constant", "110",
        "const float k = sin(0.5);\nvoid main() { gl_FragColor = vec4(k); }\n",
        "tiny.frag:2: error: 'sin()' gives no constant before GLSL 1.20"),
    row("function_in_a_size", "110",
        "void main() { float a[int(abs(-2.0))]; a[0] = 1.0; gl_FragColor = vec4(a[0]); }\n",
        "'abs()' gives no constant before GLSL 1.20"),
    row("invariant_color", "120", "invariant gl_FragColor;\nvoid main() { gl_FragColor = vec4(1.0); }\n",
        "tiny.frag:2: error: 'gl_FragColor' cannot be invariant before GLSL 1.30"),
    row("a_name_of_layouts", "330 core", with_main("float row_major = 1.0;\n", "row_major"),
        "tiny.frag:2: error: 'row_major' is no name to every driver: some keep it for the language"),
    row("a_name_of_layouts_130", "130", with_main("float row_major = 1.0;\n", "row_major"),
        "'row_major' is no name"),
    row("a_name_of_images", "330 core", with_main("float image2DMS = 1.0;\n", "image2DMS"),
        "'image2DMS' is no name"),
    row("a_name_of_layouts_es", "300 es", with_main("float packed = 1.0;\n", "packed"),
        "'packed' is no name"),
    row("macro_of_spirv", "330 core",
        with_main("#ifdef GL_SPIRV\nconst float g = 1.0;\n#else\nbroken g;\n#endif\n", "g"),
        "tiny.frag:5: error"),
    row("macro_of_spirv_defined", "330 core", "#define GL_SPIRV 7\n" + with_main("", "1.0"),
        "names beginning with \"GL_\" can't be (un)defined: GL_SPIRV"),
    row("macro_of_tools_undefined", "450", "#undef GL_EXT_ray_tracing\n" + with_main("", "1.0"),
        "names beginning with \"GL_\" can't be (un)defined: GL_EXT_ray_tracing"),
    row("macro_of_spirv_as_a_value", "450", with_main("", "float(GL_SPIRV)"),
        "'GL_SPIRV' : undeclared identifier"),
    row("macro_of_a_vulkan_extension", "450",
        with_main("#if defined GL_EXT_control_flow_attributes || defined(GL_EXT_ray_tracing)\n"
                  "const float g = 1.0;\n#else\nbroken g;\n#endif\n",
                  "g"),
        "tiny.frag:5: error"),
    row("macro_of_tools", "300 es",
        with_main("#ifdef GL_GOOGLE_include_directive\nconst float g = 1.0;\n#endif\n", "g"),
        "'g' : undeclared identifier"),
    row("quotation_in_code", "330 core", with_main("float g\" = 1.0;\n", "g"), "tiny.frag:2: error"),
    row("centroid_before_layout_410", "410", with_main("centroid layout(location = 1) in vec4 t;\n"),
        "tiny.frag:2: error: 'centroid' stands before 'layout', which came with GLSL 4.20 [default]\n"
        "    centroid layout(location = 1) in vec4 t;\n"
        "  help: write centroid right before in or out\n"),
    row("layout_behind_uniform", "450", with_main("uniform layout(std140, binding = 1) B { vec4 b; };\n"),
        "tiny.frag:2: error: 'layout' stands behind 'uniform' in the block 'B', where not every driver reads "
        "it [default]\n"
        "    uniform layout(std140, binding = 1) B { vec4 b; };\n"
        "  help: write it before 'uniform'\n"),
    row("layout_on_both_sides", "450",
        with_main("layout(std140) uniform layout(binding = 1) B { vec4 b; };\n"),
        "'layout' stands behind 'uniform' in the block 'B'"),
    row("readonly_behind_buffer", "450", with_main("layout(std430) buffer readonly B { vec4 b; };\n"),
        "'readonly' stands behind 'buffer' in the block 'B'"),
    row("layout_behind_in", "450", with_main("in layout(location = 0) B { vec4 b; };\n"),
        "'layout' stands behind 'in' in the block 'B'"),
    row("precision_of_a_block", "450", with_main("layout(std140) highp uniform B { vec4 b; };\n"),
        "tiny.frag:2: error: 'highp' stands before the block 'B', which not every driver reads [default]\n"
        "    layout(std140) highp uniform B { vec4 b; };\n"
        "  help: write it before its members\n"),
    row("default_behind_uniform", "450", with_main("uniform layout(row_major);\n"),
        "tiny.frag:2: error: 'uniform' stands before its layout, where not every driver reads it [default]\n"
        "    uniform layout(row_major);\n"
        "  help: write layout(...) uniform;\n"),
    row("default_on_both_sides", "450", with_main("layout(row_major) uniform layout(std140);\n"),
        "'uniform' stands before its layout"),
    row("early_tests_behind_in", "450", with_main("in layout(early_fragment_tests);\n"),
        "'in' stands before its layout"),
};

const Row taken[] = {
    row("number_of_the_file", "300 es", with_main("", "float(__FILE__ + __LINE__)"), ""),
    row("invariant_all_in_es_100", "100",
        "#pragma STDGL invariant(all)\nvoid main() { gl_FragColor = vec4(1.0); }\n", ""),
    row("pragma_beside_functions", "450",
        with_main("#pragma optimize(off)\nfloat f() { return 1.0; }\n#pragma debug(on)\n"), ""),
    row("struct_of_samplers_taken", "450",
        with_main("struct Map { vec2 at; sampler2D map; };\nuniform Map map;\nfloat f(in Map m) { return "
                  "texture(m.map, m.at).x; }\n",
                  "f(map)"),
        ""),
    row("orders_of_matrices_twice", "330 core",
        with_main("layout(std140, row_major, column_major, row_major) uniform B { mat4 a; };\n", "a[0].x"),
        ""),
    row("layout_behind_a_layout_420", "420",
        "layout(location = 0) layout(index = 0) out vec4 c;\nvoid main() { c = vec4(1.0); }\n", ""),
    row("void_among_the_arguments_of_a_macro", "450",
        with_main("#define FUNCTION(type, name) type name()\nFUNCTION(void, f) {}\n"), ""),
    row("void_alone", "450", with_main("float f(void) { return 1.0; }\n", "f()"), ""),
    row("layout_shared", "330 core", with_main("layout(shared) uniform B { mat3 m; } b;\n", "b.m[0].x"), ""),
    row("layout_packed", "300 es", with_main("layout(packed) uniform B { vec4 v; } b;\n", "b.v.x"), ""),
    row("fma_by_extension", "330 core",
        with_main("#extension GL_ARB_gpu_shader5 : require\n", "fma(1.0, 2.0, 3.0)"), ""),
    row("fma_by_extension_150", "150",
        with_main("#extension GL_ARB_gpu_shader5 : require\n", "fma(1.0, 2.0, 3.0)"), ""),
    row("macro_of_texture_arrays", "330 core",
        with_main("#ifdef GL_EXT_texture_array\nfloat f() { return 1.0; }\n#endif\n", "f()"), ""),
    row("int_returned_as_float_420", "420", with_main("float f() { return 1; }\n", "f()"), ""),
    row("hash_that_no_one_reads", "330 core", with_main("#if 0\n#define S(x) #x\n#endif\n"), ""),
    row("joined_names", "330 core", with_main("#define J(a, b) a##b\nfloat J(le, vel) = 1.0;\n", "level"),
        ""),
    row("align_440", "440", with_main("layout(std140) uniform B { vec4 a; layout(align = 32) vec4 b; };\n"),
        ""),
    row("align_by_extension", "430",
        with_main("#extension GL_ARB_enhanced_layouts : require\n"
                  "layout(std140, align = 32) uniform B { vec4 a; };\n"),
        ""),
    row("vulkan_guarded", "450",
        with_main(
            "#ifdef GL_EXT_nonuniform_qualifier\n#extension GL_EXT_nonuniform_qualifier : enable\n#endif\n"),
        ""),
    row("vulkan_where_its_macro_is_defined", "450",
        with_main("#ifdef GL_EXT_nonuniform_qualifier\n#extension GL_EXT_nonuniform_qualifier : enable\n"
                  "#define AT(i) nonuniformEXT(i)\n#else\n#define AT(i) i\n#endif\n",
                  "AT(1)"),
        ""),
    row("set_where_spirv_is_made", "450",
        with_main("#ifdef GL_SPIRV\nlayout(set = 0, binding = 1) uniform sampler2D map;\n#endif\n"), ""),
    row("macro_gives_defined", "330 core", with_main("#define HAS defined(FOG)\n#if HAS\nbroken\n#endif\n"),
        ""),
    row("semicolons_alone", "330 core",
        with_main("float f() { return 1.0; };;\nfloat g = 1.0;;\n", "f() + g"), ""),
    row("semicolon_first", "330 core", ";\n" + with_main(""), ""),
    row("numbers_without_sign", "330 core", with_main("#if 1u && 0x1U == 1U\nfloat g = 1.0;\n#endif\n", "g"),
        ""),
    row("semicolon_alone_in_es", "300 es", with_main("float f() { return 1.0; };\n", "f()"), ""),
    row("semicolon_behind_a_block", "330 core",
        with_main("struct S { float a; };\nlayout(std140) uniform B { vec4 b; };\nconst float k[1] = "
                  "float[1](1.0);\n"),
        ""),
    row("semicolon_of_a_branch", "330 core",
        with_main("const float a = 1.0\n#ifdef FOG\n + 1.0;\nconst float b = 2.0\n#endif\n;\n", "a"), ""),
    row("words_behind_else_and_endif", "330 core", with_main("#if 0\nbroken\n#else FOG\n#endif FOG\n"), ""),
    row("quotation_that_a_backslash_hides", "330 core", with_main("#ifdef NO\nsay \"hi\\\"\n#endif\n"), ""),
    row("version_that_no_one_reads", "330 core", with_main("#if 0\n#version 999\n#endif\n"), ""),
    row("depth_layout_by_its_extension", "150",
        "#extension GL_ARB_conservative_depth : require\nlayout(depth_less) out float gl_FragDepth;\n"
        "out vec4 c;\nvoid main() { c = vec4(1.0); gl_FragDepth = 0.5; }\n",
        ""),
    row("two_precisions_of_which_one_is_a_macro", "330 core",
        with_main("#define highp\nuniform highp mediump float q;\n"), ""),
    row("pragma_behind_a_macro", "330 core",
        with_main("#define TWICE(x) float x() { return 2.0; }\nTWICE(two)\n#pragma debug(off)\n", "two()"),
        ""),
    row("structs_called_as_samplers", "330 core",
        with_main("struct samplerState { float bias; };\nsamplerState f() { return samplerState(1.0); }\n",
                  "f().bias"),
        ""),
    row("quotation_that_no_one_reads", "330 core", with_main("#if 0\nit says \"so\n#endif\n"), ""),
    row("extension_unknown_to_glslang", "330 core",
        with_main("#extension GL_ARB_texture_query_levels : require\n#extension GL_ARB_arrays_of_arrays : "
                  "require\n"),
        ""),
    row("extension_that_brings_what_glslang_lacks", "330 core",
        with_main("#extension GL_EXT_draw_instanced : require\n#extension GL_ARB_shader_subroutine : "
                  "require\n"),
        ""),
    row("extension_that_brings_what_glslang_lacks_in_es", "320 es",
        with_main("#extension GL_EXT_shader_framebuffer_fetch_non_coherent : require\n"), ""),
    row("include_extension", "450", with_main("#extension GL_GOOGLE_include_directive : require\n"), ""),
    row("layouts_before_a_block", "450",
        with_main("layout(std430) readonly layout(binding = 1) buffer B { vec4 b; };\n"), ""),
    row("layout_behind_the_uniform_of_no_block", "450",
        with_main("uniform layout(location = 3) float s = float(2);\nlayout(std140) layout(row_major) "
                  "uniform;\n"),
        ""),
    row("centroid_behind_layout_410", "410", with_main("layout(location = 1) centroid in vec4 t;\n"), ""),
    row("centroid_before_layout_420", "420", with_main("centroid layout(location = 1) in vec4 t;\n"), ""),
    row("counter_with_binding", "430",
        with_main("layout(binding = 0, offset = 4) uniform atomic_uint hits;\n"), ""),
    row("case_of_uint_400", "400",
        "out vec4 c;\nvoid main() { c = vec4(1.0); uint i = 1u; switch (i) { case 0: break; } }\n", ""),
    row("a_name_called_flat_of_members", "450", with_main("struct S { float smoothness; };\n"), ""),
    row("macros_that_gobo_has_too", "330 core",
        "#define SAMPLER(n) uniform sampler2D n\n#define BLOCK 16\n#define OUTPUT out\nSAMPLER(map);\n"
        "OUTPUT vec4 c;\nvoid main() { c = texture(map, vec2(BLOCK)); }\n",
        ""),
    row("depth_range", "330 core", with_main("", "gl_DepthRange.diff + gl_DepthRange.near"), ""),
    row("depth_range_in_es", "300 es",
        with_main("float f(gl_DepthRangeParameters r) { return r.far; }\n", "f(gl_DepthRange)"), ""),
    row("number_of_samples", "400", with_main("", "float(gl_NumSamples)"), ""),
    row("old_texture_function_140", "140",
        "uniform sampler2D map;\nout vec4 c;\nvoid main() { c = texture2D(map, vec2(0.5)); }\n", ""),
    row("constructor_in_a_constant", "110",
        "struct S { float a; };\nconst S s = S(1.0);\nconst vec2 v = vec2(float(1), 2.0);\n"
        "void main() { float a[int(2.0)]; a[0] = sin(v.x); gl_FragColor = vec4(s.a + a[0]); }\n",
        ""),
    row("function_in_a_constant_120", "120",
        "const float k = sin(0.5);\nvoid main() { gl_FragColor = vec4(k); }\n", ""),
    row("invariant_color_130", "130", "invariant gl_FragColor;\nvoid main() { gl_FragColor = vec4(1.0); }\n",
        ""),
    row("a_name_of_layouts_120", "120",
        "float row_major = 1.0;\nvoid main() { gl_FragColor = vec4(row_major); }\n", ""),
    row("layouts_by_a_macro", "330 core",
        with_main("#define UNIFORM(l) layout(std140, l) uniform\nUNIFORM(row_major) B { mat4 m; };\n"
                  "layout(row_major) uniform;\n"),
        ""),
    row("a_call_behind_else", "450",
        "float f(float x) { return x; }\nout vec4 c;\nvoid main() { if (gl_FrontFacing) c = vec4(1.0); "
        "else f(1.0); c = vec4(0.0); }\n",
        ""),
};

/// The macros that drivers define by the version.
const Row macros_of_versions[] = {
    row("version_100", "100",
        branch("defined GL_ES && __VERSION__ == 100 && !defined GL_es_profile && !defined GL_core_profile"),
        ""),
    row("version_110", "110",
        branch("__VERSION__ == 110 && !defined GL_ES && !defined GL_core_profile && !defined "
               "GL_compatibility_profile"),
        ""),
    row("version_120", "120",
        branch("__VERSION__ == 120 && !defined GL_ES && !defined GL_core_profile && !defined "
               "GL_compatibility_profile"),
        ""),
    row("version_130", "130",
        branch("__VERSION__ == 130 && !defined GL_ES && !defined GL_core_profile && !defined "
               "GL_compatibility_profile"),
        ""),
    row("version_140", "140",
        branch("__VERSION__ == 140 && !defined GL_ES && !defined GL_core_profile && !defined "
               "GL_compatibility_profile",
               "c"),
        ""),
    row("version_150", "150",
        branch("__VERSION__ == 150 && GL_core_profile == 1 && !defined GL_ES && !defined "
               "GL_compatibility_profile",
               "c"),
        ""),
    row("version_330", "330",
        branch("__VERSION__ == 330 && GL_core_profile == 1 && !defined GL_ES && !defined "
               "GL_compatibility_profile",
               "c"),
        ""),
    row("version_400", "400",
        branch("__VERSION__ == 400 && GL_core_profile == 1 && !defined GL_ES && !defined "
               "GL_compatibility_profile",
               "c"),
        ""),
    row("version_450", "450",
        branch("__VERSION__ == 450 && GL_core_profile == 1 && !defined GL_ES && !defined "
               "GL_compatibility_profile",
               "c"),
        ""),
    row("version_150_compatibility", "150 compatibility",
        branch("__VERSION__ == 150 && GL_compatibility_profile == 1 && !defined GL_core_profile", "c"), ""),
    row("version_330_compatibility", "330 compatibility",
        branch("__VERSION__ == 330 && GL_compatibility_profile == 1 && !defined GL_core_profile", "c"), ""),
    row("version_300_es", "300 es",
        branch("__VERSION__ == 300 && GL_ES == 1 && !defined GL_es_profile && !defined GL_core_profile", "c"),
        ""),
    row("version_310_es", "310 es",
        branch("__VERSION__ == 310 && GL_ES == 1 && !defined GL_es_profile && !defined GL_core_profile", "c"),
        ""),
    row("version_320_es", "320 es",
        branch("__VERSION__ == 320 && GL_ES == 1 && !defined GL_es_profile && !defined GL_core_profile", "c"),
        ""),
};

constexpr auto name_of_row = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Refused, Language, testing::ValuesIn(refused), name_of_row);
INSTANTIATE_TEST_SUITE_P(Taken, Language, testing::ValuesIn(taken), name_of_row);
INSTANTIATE_TEST_SUITE_P(Macros, Language, testing::ValuesIn(macros_of_versions), name_of_row);

struct StagesRow {
    const char* name;
    const char* version;
    std::vector<std::pair<StageKind, const char*>> stages;  ///< beside the usual pair, or a compute stage
    const char* message;  ///< of the error, in part; empty where both take it
};

void PrintTo(const StagesRow& row, std::ostream* stream) {
    *stream << row.name;
}

class LanguageOfStages : public testing::TestWithParam<StagesRow> {
  protected:
    static void check(const StagesRow& row, bool is_warning);
};

TEST_P(LanguageOfStages, IsTakenAsMesaTakesIt) {
    check(GetParam(), false);
}

void LanguageOfStages::check(const StagesRow& row, bool is_warning) {
    const std::string head = fmt::format("#version {}\n{}", row.version,
                                         std::string_view(row.version).ends_with("es")
                                             ? "precision highp float; precision highp image2D;\n"
                                             : "");
    PerStage<std::string> texts;
    if (row.stages.front().first != StageKind::compute) {
        texts[StageKind::vertex] = "void main() { gl_Position = vec4(0.0); }\n";
        texts[StageKind::fragment] = "out vec4 c;\nvoid main() { c = vec4(1.0); }\n";
    }
    for (const auto& [kind, text] : row.stages) texts[kind] = text;
    std::string toml = "name = \"tiny\"\n";
    std::map<std::string, std::string, std::less<>> files;
    for (const StageNames& stage : kStages) {
        if (texts[stage.kind].empty()) continue;
        toml += fmt::format("{0} = \"tiny.{1}\"\n", stage.name, stage.infix);
        files[fmt::format("tiny.{}", stage.infix)] = head + texts[stage.kind];
    }
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = read_family(toml, "tiny.toml", {}).value();
    const Composition composition = compose(family, {{}}, search, Dialect::own).value();
    std::string errors;
    std::string warnings;
    for (const Diagnostic& diagnostic : validate(family, composition, {}).diagnostics)
        (diagnostic.severity == Severity::error ? errors : warnings) += to_text(diagnostic);
    const bool is_taken = is_warning || *row.message == '\0';
    EXPECT_EQ(errors.empty(), is_taken) << errors;
    EXPECT_THAT(is_warning ? warnings : errors, testing::HasSubstr(row.message));

    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context);
    const Result<Program> program =
        link_program(*context, stages_of(composition, composition.permutations.front()));
    EXPECT_EQ(program.has_value(), is_taken) << (program ? "it links" : first_text(program.error()));
}

#define TRIANGLES "layout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\n"
constexpr const char* kControl =
    "layout(vertices = 3) out;\nvoid main() { gl_TessLevelOuter[0] = gl_TessLevelInner[0] = 1.0; }\n";
constexpr const char* kEvaluation =
    "layout(triangles) in;\nvoid main() { gl_Position = vec4(gl_TessCoord, 1.0); }\n";

#define GROUP "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer B { float b; };\n"

const StagesRow stages[] = {
    {"no_position_before_140",
     "130",
     {{StageKind::vertex, "in vec4 p;\nout vec4 q;\nvoid main() { q = p; }\n"}},
     "tiny.vert: error: the vertex stage never writes gl_Position"},
    {"inputs_of_two_primitives",
     "150",
     {{StageKind::geometry,
       "layout(points, triangles) in;\nlayout(points, max_vertices = 1) out;\n"
       "void main() { gl_Position = vec4(0.0); EmitVertex(); }\n"}},
     "tiny.geom:2: error: layout states both points and triangles"},
    {"attribute_of_whole_numbers",
     "110",
     {{StageKind::vertex, "attribute ivec2 a;\nvoid main() { gl_Position = vec4(a, a); }\n"},
      {StageKind::fragment, "void main() { gl_FragColor = vec4(1.0); }\n"}},
     kNewerGlslang ? "tiny.vert:2: error: 'non-float shader input/output'"
                   : "tiny.vert:2: error: a vertex input of type ivec2 came with GLSL 1.20"},
    {"shared_memory",
     "430",
     {{StageKind::compute,
       GROUP "shared float s[8193];\nvoid main() { s[gl_LocalInvocationIndex] = 1.0; b = s[0]; }\n"}},
     "tiny.comp:4: error: bytes of shared variables: 32772, OpenGL guarantees only 32768 "
     "(MAX_COMPUTE_SHARED_MEMORY_SIZE)"},
    {"shared_memory_of_two",
     "430",
     {{StageKind::compute, GROUP "shared float s[5000];\nshared float t[5000];\nvoid main() { s[0] = t[0] = "
                                 "1.0; b = s[0] + t[0]; }\n"}},
     "bytes of shared variables: 40000"},
    {"shared_memory_of_vectors",
     "430",
     {{StageKind::compute, GROUP "shared vec3 s[2100];\nvoid main() { s[0] = vec3(1.0); b = s[0].x; }\n"}},
     "bytes of shared variables: 33596"},
    {"shared_memory_in_es",
     "310 es",
     {{StageKind::compute, GROUP "shared float s[9000];\nvoid main() { s[0] = 1.0; b = s[0]; }\n"}},
     "bytes of shared variables: 36000"},
    {"shared_memory_filled",
     "430",
     {{StageKind::compute,
       GROUP "shared float s[8192];\nshared float unread[100];\nvoid main() { s[0] = 1.0; b = s[0]; }\n"}},
     ""},
    {"readonly_and_writeonly",
     "430",
     {{StageKind::compute,
       "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) coherent restrict readonly writeonly "
       "buffer B { "
       "float b; };\nvoid main() {}\n"}},
     "tiny.comp:3: error: the buffer block 'B' is both readonly and writeonly"},
    {"readonly_and_writeonly_member",
     "430",
     {{StageKind::compute,
       "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer B { coherent restrict readonly "
       "writeonly "
       "float b[]; };\nlayout(std430, binding = 1) buffer D { int n; };\nvoid main() { n = b.length(); }\n"}},
     ""},
    {"stream_of_an_output",
     "430",
     {{StageKind::geometry,
       "layout(points) in;\nlayout(points, max_vertices = 3) out;\nlayout(stream = 4) out float f;\n"
       "void main() { f = 1.0; gl_Position = vec4(0.0); EmitVertex(); }\n"}},
     "tiny.geom:4: error: stream 4: OpenGL guarantees only 4, from 0 (MAX_VERTEX_STREAMS)"},
    {"stream_that_is_none",
     "430",
     {{StageKind::geometry,
       "layout(points) in;\nlayout(points, max_vertices = 3) out;\n"
       "void main() { gl_Position = vec4(0.0); EmitStreamVertex(4); }\n"}},
     "tiny.geom:4: error: streams up to that of EmitStreamVertex(): 5, OpenGL guarantees only 4 "
     "(MAX_VERTEX_STREAMS)"},
    {"wide_attributes",
     "430",
     {{StageKind::vertex,
       "in dmat4 a;\nin dmat4 b;\nin dvec3 d;\n"
       "void main() { gl_Position = vec4(a[0] + b[3] + dvec4(d, 1.0)); }\n"}},
     "tiny.vert: error: vertex attribute locations: 18, OpenGL guarantees only 16 (MAX_VERTEX_ATTRIBS)"},
    {"attributes_of_two_doubles",
     "430",
     {{StageKind::vertex,
       "in dmat4 a;\nin dmat4x2 b;\nin dvec2 d;\n"
       "void main() { gl_Position = vec4(a[0] + dvec4(b[3], d)); }\n"}},
     ""},
    {"invocations",
     "430",
     {{StageKind::geometry,
       "layout(triangles, invocations = 33) in;\nlayout(triangle_strip, max_vertices = 3) out;\n"
       "void main() { gl_Position = vec4(0.0); EmitVertex(); }\n"}},
     "tiny.geom:2: error: invocations of the geometry stage: 33, OpenGL guarantees only 32"},
    {"stream_of_triangles",
     "430",
     {{StageKind::geometry, TRIANGLES "void main() { gl_Position = vec4(0.0); EmitStreamVertex(1); }\n"}},
     "tiny.geom:4: error: stream 1 takes points alone"},
    {"stream_of_points",
     "430",
     {{StageKind::geometry,
       "layout(points) in;\nlayout(points, max_vertices = 3) out;\n"
       "void main() { gl_Position = vec4(0.0); EmitStreamVertex(1); }\n"}},
     ""},
    {"patch_vertices",
     "430",
     {{StageKind::tess_control, "layout(vertices = 33) out;\nvoid main() { gl_TessLevelOuter[0] = 1.0; }\n"},
      {StageKind::tess_evaluation, kEvaluation}},
     "tiny.tesc:2: error: vertices of a patch: 33, OpenGL guarantees only 32"},
    {"tessellation",
     "430",
     {{StageKind::tess_control, kControl}, {StageKind::tess_evaluation, kEvaluation}},
     ""},
    {"evaluation_alone", "430", {{StageKind::tess_evaluation, kEvaluation}}, ""},
    {"evaluation_alone_in_es",
     "320 es",
     {{StageKind::tess_evaluation, kEvaluation}},
     "a program of OpenGL ES with a tess_evaluation stage needs a tess_control stage"},
    {"group_too_large",
     "430",
     {{StageKind::compute, "layout(local_size_x = 64, local_size_y = 32) in;\nvoid main() {}\n"}},
     "tiny.comp:2: error: invocations of a work group: 2048, OpenGL guarantees only 1024"},
    {"interpolation_before_a_macro_and_a_layout",
     "430",
     {{StageKind::vertex,
       "#define INTERFACE(n) layout(location = n) out\nflat INTERFACE(1) int a;\n"
       "flat layout(location = 2) out int b;\n"
       "void main() { a = b = 1; gl_Position = vec4(0.0); }\n"},
      {StageKind::fragment,
       "layout(location = 1) flat in int a;\nflat layout(location = 2) in int b;\nout vec4 c;\n"
       "void main() { c = vec4(a + b); }\n"}},
     ""},
    {"storage_binding",
     "430",
     {{StageKind::compute,
       "layout(local_size_x = 1) in;\nlayout(std430, binding = 500) buffer B { float b; };\n"
       "void main() { b = 1.0; }\n"}},
     "storage buffer bindings up to that of 'B': 501"},
    {"writeonly_is_read",
     "430",
     {{StageKind::compute,
       "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) writeonly buffer B { uint sum[]; };\n"
       "void main() { sum[0] += 1u; }\n"}},
     "tiny.comp:3: error: 'sum' is writeonly, and is read"},
    {"writeonly_has_a_length",
     "430",
     {{StageKind::compute,
       "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) writeonly buffer B { uint sum[]; };\n"
       "void main() { sum[sum.length() - 1] = 1u; }\n"}},
     ""},
    {"image_without_format_in_es",
     "310 es",
     {{StageKind::compute,
       "layout(local_size_x = 1) in;\nlayout(binding = 0) uniform writeonly image2D map;\n"
       "void main() { imageStore(map, ivec2(0), vec4(1.0)); }\n"}},
     "tiny.comp:4: error: the image 'map' states no format"},
    {"image_with_format_in_es",
     "310 es",
     {{StageKind::compute,
       "layout(local_size_x = 1) in;\nlayout(rgba8, binding = 0) uniform writeonly image2D map;\n"
       "void main() { imageStore(map, ivec2(0), vec4(1.0)); }\n"}},
     ""},
    {"components_of_two_types",
     "450",
     {{StageKind::vertex,
       "layout(location = 0) out vec3 a;\nlayout(location = 0, component = 3) flat out int b;\n"
       "void main() { a = vec3(1.0); b = 1; gl_Position = vec4(0.0); }\n"},
      {StageKind::fragment,
       "layout(location = 0) in vec3 a;\nlayout(location = 0, component = 3) flat in int b;\n"
       "out vec4 c;\nvoid main() { c = vec4(a, b); }\n"}},
     kNewerGlslang ? "the aliases sharing the location 0 must be the same basic type"
                   : "'vec3 a' and 'int b' share location 0 and have not one numerical type"},
    {"clip_and_cull_distances",
     "450",
     {{StageKind::vertex,
       "out float gl_ClipDistance[6];\nout float gl_CullDistance[6];\n"
       "void main() { gl_ClipDistance[5] = gl_CullDistance[5] = 1.0; gl_Position = vec4(0.0); }\n"}},
     "clip and cull distances: 12, OpenGL guarantees only 8"},
    {"second_source_at_1",
     "430",
     {{StageKind::fragment, "layout(location = 1, index = 1) out vec4 b;\nvoid main() { b = vec4(1.0); }\n"}},
     "an output of index 1 stands at location 0 alone"},
};

/// What gobo warns of and Mesa takes, for other drivers need not.
const StagesRow warned[] = {
    {"extension_of_one_vendor",
     "450",
     {{StageKind::fragment,
       "#extension GL_AMD_shader_trinary_minmax : require\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n"}},
     "tiny.frag:2:1: warning: not every driver has GL_AMD_shader_trinary_minmax, and none that lacks it "
     "compiles this "
     "stage"},
    {"nine_images",
     "430",
     {{StageKind::compute,
       "layout(local_size_x = 1) in;\nlayout(rgba8) uniform writeonly image2D m[9];\n"
       "void main() { for (int i = 0; i < 9; ++i) imageStore(m[i], ivec2(0), vec4(1.0)); }\n"}},
     "warning: images in the compute stage: 9, OpenGL guarantees only 8 (MAX_COMPUTE_IMAGE_UNIFORMS)"},
    {"nine_counters",
     "430",
     {{StageKind::fragment,
       "layout(binding = 0) uniform atomic_uint a[9];\nout vec4 c;\n"
       "void main() { c = vec4(atomicCounterIncrement(a[8])); }\n"}},
     "warning: atomic counters in the fragment stage: 9, OpenGL guarantees only 8 "
     "(MAX_FRAGMENT_ATOMIC_COUNTERS)"},
    {"storage_in_the_vertex_stage",
     "430",
     {{StageKind::vertex,
       "layout(std430, binding = 0) buffer B { vec4 b; };\nvoid main() { gl_Position = b; }\n"}},
     "warning: storage blocks in the vertex stage: 1, OpenGL guarantees only 0 "
     "(MAX_VERTEX_SHADER_STORAGE_BLOCKS)"},
    {"image_in_the_vertex_stage",
     "430",
     {{StageKind::vertex,
       "layout(rgba8, binding = 0) uniform readonly image2D m;\nvoid main() { gl_Position = imageLoad(m, "
       "ivec2(0)); "
       "}\n"}},
     "warning: images in the vertex stage: 1, OpenGL guarantees only 0 (MAX_VERTEX_IMAGE_UNIFORMS)"},
    {"its_own_line_in_a_macro",
     "430",
     {{StageKind::fragment, "out vec4 c;\n#define HERE __LINE__\nvoid main() { c = vec4(HERE); }\n"}},
     "tiny.frag:3: warning: '__LINE__' is another number to each driver"},
    {"its_own_line_counted_anew",
     "430",
     {{StageKind::fragment,
       "out vec4 c;\n#line 7\n#if __LINE__ == 0\n#endif\nvoid main() { c = vec4(1.0); }\n"}},
     "tiny.frag:4: warning: '__LINE__' is another number to each driver"},
    {"far_location",
     "430",
     {{StageKind::fragment,
       "layout(location = 1020) uniform float u[8];\nout vec4 c;\nvoid main() { c = vec4(u[7]); }\n"}},
     "tiny.frag:2: warning: uniform locations up to the last of 'u': 1028, OpenGL guarantees only 1024 "
     "(MAX_UNIFORM_LOCATIONS)"},
    {"group_in_es",
     "310 es",
     {{StageKind::compute, "layout(local_size_x = 129) in;\nvoid main() {}\n"}},
     "warning: invocations of a work group: 129, OpenGL guarantees only 128 "
     "(MAX_COMPUTE_WORK_GROUP_INVOCATIONS of "
     "OpenGL ES)"},
    {"shared_memory_in_es",
     "310 es",
     {{StageKind::compute, GROUP "shared float s[5000];\nvoid main() { s[0] = 1.0; b = s[0]; }\n"}},
     "tiny.comp:5: warning: bytes of shared variables: 20000, OpenGL guarantees only 16384 "
     "(MAX_COMPUTE_SHARED_MEMORY_SIZE of OpenGL ES)"},
    {"block_without_a_layout",
     "430",
     {{StageKind::fragment, "int a;\nuniform // b\n A { vec4 b; };\nout vec4 c;\nvoid main() { c = b; }\n"}},
     "tiny.frag:4: warning: the uniform block 'A' does not state std140: drivers lay it out as they like"},
    {"block_of_another_layout",
     "430",
     {{StageKind::fragment,
       "layout(shared, binding = 1) uniform A { vec4 b; };\nout vec4 c;\nvoid main() { c = b; }\n"}},
     "the uniform block 'A' does not state std140"},
    {"block_behind_one_that_states_its_layout",
     "430",
     {{StageKind::fragment,
       "layout(std140) uniform A { vec4 a; };\nuniform B { vec4 b; };\nout vec4 c;\n"
       "void main() { c = b; }\n"}},
     "the uniform block 'B' does not state std140"},
};

class LanguageOfDrivers : public LanguageOfStages {};

TEST_P(LanguageOfDrivers, IsWarnedOf) {
    check(GetParam(), true);
}

INSTANTIATE_TEST_SUITE_P(Rows, LanguageOfDrivers, testing::ValuesIn(warned), name_of_row);
INSTANTIATE_TEST_SUITE_P(Rows, LanguageOfStages, testing::ValuesIn(stages), name_of_row);

}  // namespace
}  // namespace gobo
