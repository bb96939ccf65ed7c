#include "validate/glsl_version.hpp"

#include <charconv>

#include "core/text.hpp"

namespace gobo {
namespace {

/// The texture functions of before GLSL 1.30, which carried their sampler's type in their name.
constexpr std::string_view renamed_functions =
    "#define texture1D texture\n"
    "#define texture1DProj textureProj\n"
    "#define texture1DLod textureLod\n"
    "#define texture2D texture\n"
    "#define texture2DProj textureProj\n"
    "#define texture2DLod textureLod\n"
    "#define texture2DProjLod textureProjLod\n"
    "#define texture3D texture\n"
    "#define texture3DProj textureProj\n"
    "#define texture3DLod textureLod\n"
    "#define textureCube texture\n"
    "#define textureCubeLod textureLod\n";

}  // namespace

GlslVersion version_of(std::string_view prologue) {
    GlslVersion version;
    constexpr std::string_view directive = "#version ";
    if (!prologue.starts_with(directive)) return version;
    const std::string_view line =
        trim(prologue.substr(directive.size(), prologue.find('\n') - directive.size()));
    const auto parsed = std::from_chars(line.data(), line.data() + line.size(), version.number);
    version.profile = trim(line.substr(static_cast<std::size_t>(parsed.ptr - line.data())));
    version.es = version.profile == "es" || version.number == 100;
    return version;
}

bool makes_spirv(const GlslVersion& version) {
    return version.number >= (version.es ? 310 : 330) && version.profile != "compatibility";
}

std::string raised_for_spirv(std::string_view prologue) {
    const GlslVersion version = version_of(prologue);
    const auto end = prologue.find('\n');
    const std::string_view rest =
        prologue.starts_with("#version") && end != std::string_view::npos ? prologue.substr(end) : "\n";
    // ES 100 goes with the desktop's: 310 es has no attribute and varying, 330 core still has.
    const bool is_first_es = version.es && version.number == 100;
    const std::string line = version.es && !is_first_es ? "#version 310 es" : "#version 330 core";
    if (!is_first_es && (version.es || version.number >= 130)) return line + std::string(rest);
    return line + "\n" + std::string(renamed_functions) + std::string(rest);
}

}  // namespace gobo
