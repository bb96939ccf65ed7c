// What glslang and drivers take of GLSL's language: whether gobo accepts a text, Mesa links what gobo ships
// of it.
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "lab/render/program.hpp"
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

const Row refused[] = {
    row("int_returned_as_float", "330 core", with_main("float f() { return 1; }\n", "f()"),
        "tiny.frag:2: error: 'return' of another type than the function's: GLSL converts it from 4.20 on"),
    row("macro_makes_a_string", "450", with_main("#define S(x) #x\n"),
        "tiny.frag:2: error: the macro 'S' makes a string by '#', which GLSL has not"),
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
    row("own_version", "450", with_main("#define __VERSION__ 330\n"), "'__VERSION__' is GLSL's own"),
    row("quotation_in_code", "330 core", with_main("float g\" = 1.0;\n", "g"), "tiny.frag:2: error"),
};

const Row taken[] = {
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
    row("macro_gives_defined", "330 core", with_main("#define HAS defined(FOG)\n#if HAS\nbroken\n#endif\n"),
        ""),
    row("semicolons_alone", "330 core",
        with_main("float f() { return 1.0; };;\nfloat g = 1.0;;\n", "f() + g"), ""),
    row("semicolon_alone_in_es", "300 es", with_main("float f() { return 1.0; };\n", "f()"), ""),
    row("semicolon_behind_a_block", "330 core",
        with_main("struct S { float a; };\nlayout(std140) uniform B { vec4 b; };\nconst float k[1] = "
                  "float[1](1.0);\n"),
        ""),
    row("semicolon_of_a_branch", "330 core",
        with_main("const float a = 1.0\n#ifdef FOG\n + 1.0;\nconst float b = 2.0\n#endif\n;\n", "a"), ""),
    row("words_behind_else_and_endif", "330 core", with_main("#if 0\nbroken\n#else FOG\n#endif FOG\n"), ""),
    row("quotation_that_no_one_reads", "330 core", with_main("#if 0\nit says \"so\n#endif\n"), ""),
    row("extension_unknown_to_glslang", "330 core",
        with_main("#extension GL_ARB_texture_query_levels : require\n#extension GL_ARB_arrays_of_arrays : "
                  "require\n"),
        ""),
    row("include_extension", "450", with_main("#extension GL_GOOGLE_include_directive : require\n"), ""),
    row("counter_with_binding", "430",
        with_main("layout(binding = 0, offset = 4) uniform atomic_uint hits;\n"), ""),
    row("case_of_uint_400", "400",
        "out vec4 c;\nvoid main() { c = vec4(1.0); uint i = 1u; switch (i) { case 0: break; } }\n", ""),
    row("depth_range", "330 core", with_main("", "gl_DepthRange.diff + gl_DepthRange.near"), ""),
    row("depth_range_in_es", "300 es",
        with_main("float f(gl_DepthRangeParameters r) { return r.far; }\n", "f(gl_DepthRange)"), ""),
    row("number_of_samples", "400", with_main("", "float(gl_NumSamples)"), ""),
    row("old_texture_function_140", "140",
        "uniform sampler2D map;\nout vec4 c;\nvoid main() { c = texture2D(map, vec2(0.5)); }\n", ""),
    row("a_call_behind_else", "450",
        "float f(float x) { return x; }\nout vec4 c;\nvoid main() { if (gl_FrontFacing) c = vec4(1.0); "
        "else f(1.0); c = vec4(0.0); }\n",
        ""),
};

constexpr auto name_of_row = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Refused, Language, testing::ValuesIn(refused), name_of_row);
INSTANTIATE_TEST_SUITE_P(Taken, Language, testing::ValuesIn(taken), name_of_row);

}  // namespace
}  // namespace gobo
