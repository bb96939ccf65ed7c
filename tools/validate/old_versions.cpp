#include "validate/old_versions.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "compose/rewrite.hpp"
#include "compose/search_path.hpp"

namespace gobo {
namespace {

/// Behind the names of functions that glslang has and the shader's version has not.
constexpr std::string_view kOwnName = "_of_the_shader";

/// Functions that every version of OpenGL ES has: a shader may not define one of the same name.
constexpr std::string_view kEsFunctions =
    " radians degrees sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh pow exp log exp2 log2 sqrt "
    "inversesqrt abs sign floor trunc round roundEven ceil fract mod modf min max clamp mix step smoothstep "
    "isnan "
    "isinf floatBitsToInt floatBitsToUint intBitsToFloat uintBitsToFloat packSnorm2x16 unpackSnorm2x16 "
    "packUnorm2x16 unpackUnorm2x16 packHalf2x16 unpackHalf2x16 length distance dot cross normalize "
    "faceforward "
    "reflect refract matrixCompMult outerProduct transpose determinant inverse lessThan lessThanEqual "
    "greaterThan "
    "greaterThanEqual equal notEqual any all not textureSize texture textureProj textureLod textureOffset "
    "texelFetch texelFetchOffset textureProjOffset textureLodOffset textureProjLod textureProjLodOffset "
    "textureGrad textureGradOffset textureProjGrad textureProjGradOffset dFdx dFdy fwidth ";

/// Extensions that drivers have and glslang does not know; what they bring is in the versions that glslang
/// checks by, or is told where it is used.
constexpr std::array<std::string_view, 14> kUnknownToGlslang = {
    "GL_ARB_arrays_of_arrays",     "GL_ARB_compatibility",    "GL_ARB_conservative_depth",
    "GL_AMD_conservative_depth",   "GL_ARB_cull_distance",    "GL_ARB_draw_buffers",
    "GL_ARB_ES3_1_compatibility",  "GL_ARB_shader_precision", "GL_ARB_fragment_layer_viewport",
    "GL_ARB_texture_query_levels", "GL_EXT_texture_array",    "GL_AMD_vertex_shader_layer",
    "GL_EXT_clip_cull_distance",   "GL_EXT_draw_buffers"};

/// Extensions that drivers have and glslang does not know, nor what they bring: a stage may require them, and
/// use what glslang knows.
constexpr std::array<std::string_view, 14> kOnlyOfDrivers = {"GL_AMD_gpu_shader_int64",
                                                             "GL_AMD_shader_stencil_export",
                                                             "GL_AMD_texture_texture4",
                                                             "GL_AMD_vertex_shader_viewport_index",
                                                             "GL_ARB_ES3_2_compatibility",
                                                             "GL_ARB_shader_subroutine",
                                                             "GL_ARM_shader_framebuffer_fetch_depth_stencil",
                                                             "GL_EXT_draw_instanced",
                                                             "GL_EXT_shader_framebuffer_fetch",
                                                             "GL_EXT_shader_framebuffer_fetch_non_coherent",
                                                             "GL_EXT_texture_shadow_lod",
                                                             "GL_INTEL_shader_atomic_float_minmax",
                                                             "GL_MESA_shader_integer_functions",
                                                             "GL_NV_shader_atomic_float"};

bool is_any_of(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

/// The lowest version that has what this one has and of which glslang makes SPIR-V.
std::string raised_version(const GlslVersion& version) {
    // ES 100 goes with the desktop's: 310 es has no attribute and varying, 330 core still has.
    if (version.es && version.number != 100) return "310 es";
    return fmt::format("{} core", std::max(version.number, 330));
}

/// Those of GL_ARB_shader_texture_lod.
std::string renamed_gradients() {
    std::string text;
    for (const char* kind : {"", "Proj"}) {
        for (const char* shape : {"1D", "2D", "3D", "Cube"})
            text += fmt::format("#define texture{0}{1}GradARB texture{1}Grad\n", shape, kind);
        for (const char* shape : {"1D", "2D"})
            text += fmt::format("#define shadow{0}{1}GradARB(s, p, x, y) vec4(texture{1}Grad(s, p, x, y))\n",
                                shape, kind);
    }
    return text;
}

}  // namespace

std::string renamed_functions() {
    std::string text;
    for (const char* shape : {"1D", "2D", "3D", "Cube", "2DRect"})
        for (const char* kind : {"", "Proj", "Lod", "ProjLod"})
            text += fmt::format("#define texture{0}{1} texture{1}\n", shape, kind);
    for (const char* shape : {"1D", "2D", "2DRect"}) {
        for (const char* kind : {"", "Proj"}) {
            text += fmt::format("#define shadow{0}{1}(s, p) vec4(texture{1}(s, p))\n", shape, kind);
            text +=
                fmt::format("#define shadow{0}{1}Lod(s, p, l) vec4(texture{1}Lod(s, p, l))\n", shape, kind);
        }
    }
    return text + renamed_gradients();
}

std::string old_functions(StageKind stage) {
    std::string text = renamed_gradients();
    const auto add = [&](std::string_view name, std::string_view sampler, std::string_view place,
                         std::string_view kind) {
        const bool is_shadow = name.starts_with("shadow");
        const auto add_call = [&](std::string_view lod, std::string_view more, std::string_view value) {
            const std::string call = fmt::format("texture{}{}(s, p{})", kind, lod, value);
            text += fmt::format("vec4 {}{}{}({} s, {} p{}) {{ return {}; }}\n", name, kind, lod, sampler,
                                place, more, is_shadow ? "vec4(" + call + ")" : call);
        };
        add_call("", "", "");
        if (stage == StageKind::fragment) add_call("", ", float b", ", b");
        add_call("Lod", ", float l", ", l");
    };
    add("texture1D", "sampler1D", "float", "");
    add("texture2D", "sampler2D", "vec2", "");
    add("texture3D", "sampler3D", "vec3", "");
    add("textureCube", "samplerCube", "vec3", "");
    for (const char* place : {"vec2", "vec4"}) add("texture1D", "sampler1D", place, "Proj");
    for (const char* place : {"vec3", "vec4"}) add("texture2D", "sampler2D", place, "Proj");
    add("texture3D", "sampler3D", "vec4", "Proj");
    for (const char* shape : {"1D", "2D"}) {
        add(fmt::format("shadow{}", shape), fmt::format("sampler{}Shadow", shape), "vec3", "");
        add(fmt::format("shadow{}", shape), fmt::format("sampler{}Shadow", shape), "vec4", "Proj");
    }
    return text;
}

std::set<std::string> taken_names(const Diagnostics& errors, const std::vector<const Piece*>& pieces) {
    std::set<std::string> names;
    const GlslVersion version = version_of(pieces.front()->text);
    if (!version.es || version.number > 300) return names;
    for (const Diagnostic& error : errors) {
        const std::size_t end = error.message.find("' : ");
        if (!error.message.starts_with('\'') || end == std::string::npos) continue;
        const std::string_view rest = std::string_view(error.message).substr(end + 4);
        if (rest.starts_with("function name is redeclaration") ||
            rest.starts_with("redefinition of built-in"))
            names.insert(error.message.substr(1, end - 1));
    }
    std::erase_if(names, [&](const std::string& name) {
        return kEsFunctions.find(fmt::format(" {} ", name)) != std::string_view::npos ||
               std::ranges::any_of(pieces, [&](const Piece* piece) {
                   return piece->text.find("." + name) != std::string::npos;
               });
    });
    return names;
}

std::string with_own_names(std::string prologue, const std::set<std::string>& names) {
    for (const std::string& name : names) prologue += fmt::format("#define {0} {0}{1}\n", name, kOwnName);
    return prologue;
}

bool makes_spirv(const GlslVersion& version) {
    return version.number >= (version.es ? 310 : 330) && version.profile != "compatibility";
}

bool has_old_functions(const GlslVersion& version) {
    return version.es ? version.number < 300 : version.number < 150 || version.profile == "compatibility";
}

std::string raised_for_spirv(std::string_view prologue, const std::string& functions,
                             const std::string& raised) {
    const GlslVersion version = version_of(prologue);
    const auto end = prologue.find('\n');
    const std::string_view rest =
        prologue.starts_with("#version") && end != std::string_view::npos ? prologue.substr(end) : "\n";
    return fmt::format("#version {}{}{}", raised.empty() ? raised_version(version) : raised,
                       has_old_functions(version) ? "\n" + functions : "", rest);
}

std::string without_requirements(std::string prologue) {
    if (prologue.find(" : require\n") == std::string::npos) return prologue;
    const auto relax = [&](std::string_view extension) {
        const std::string required = fmt::format("#extension {} : require\n", extension);
        if (const auto at = prologue.find(required); at != std::string::npos)
            prologue.replace(at, required.size(), fmt::format("#extension {} : enable\n", extension));
    };
    std::ranges::for_each(kUnknownToGlslang, relax);
    std::ranges::for_each(kOnlyOfDrivers, relax);
    return prologue;
}

bool is_unknown_to_glslang(std::string_view extension) {
    return extension != "GL_ARB_compatibility" &&
           std::ranges::find(kUnknownToGlslang, extension) != kUnknownToGlslang.end();
}

Diagnostics explained(Diagnostics diagnostics, const GlslVersion& version) {
    std::erase_if(diagnostics, [](const Diagnostic& found) { return found.severity != Severity::error; });
    for (Diagnostic& diagnostic : diagnostics) {
        if (!diagnostic.help.empty()) continue;
        diagnostic.help = fmt::format(
            "glslang makes no SPIR-V of GLSL {}{}{}, so gobo reads it as {}, which lacks this; write it with "
            "what that has",
            version.number, version.profile.empty() ? "" : " ", version.profile, raised_version(version));
    }
    return diagnostics;
}

Diagnostics with_version_missed(Diagnostics found, const Family& family, const Composition& composition) {
    if (composition.dialect != Dialect::own || !family.version.empty() || exit_status(found) == 0)
        return found;
    const auto states_version = [](const Piece& piece) {
        return piece.file_text.find("#version") != std::string::npos;
    };
    if (std::ranges::any_of(composition.pieces, states_version)) return found;
    for (Diagnostic& diagnostic : found) {
        const std::string_view message = diagnostic.message;
        if (diagnostic.severity != Severity::error || !message.starts_with('\'')) continue;
        const std::string name(message.substr(1, message.find('\'', 1) - 1));
        const bool is_output = name == "gl_FragColor" || name == "gl_FragData";
        const bool is_built_in = is_any_of(legacy_names(), legacy_name(name));
        if (!is_built_in && !is_any_of(legacy_names(), name)) continue;
        const bool is_gone = (is_built_in && !is_output) || name == "ftransform";
        diagnostic.help =
            fmt::format("no file states a #version, so 450 core is taken: write {}",
                        is_shader_file(family.path) ? "it at the top, as #version 120, or 100 for OpenGL ES"
                        : is_gone ? "version = \"120\" and compatibility = true into the family file"
                                  : "version = \"120\" into the family file, or \"100\" for OpenGL ES");
    }
    return found;
}

}  // namespace gobo
