#include "validate/missing_built_ins.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "compose/language_names.hpp"
#include "compose/scan_piece.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "validate/old_versions.hpp"

namespace gobo {
namespace {

constexpr std::string_view kOwnPrefix = "gobo_built_in_";
constexpr std::string_view kUndefinedPrefix = "gobo_undefined_";
constexpr std::string_view kDefinedByDrivers = "gobo_defined_by_drivers";

/// The macros that are defined by the version, which glslang is given another one of, with names for it of
/// the same length: columns stay.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kVersionMacros = {
    {{"__VERSION__", "own_VERSION"},
     {"GL_ES", "gL_ES"},
     {"GL_core_profile", "gL_core_profile"},
     {"GL_es_profile", "gL_es_profile"},
     {"GL_compatibility_profile", "gL_compatibility_profile"}}};

struct BuiltIn {
    std::string_view name;
    std::string_view type;
    bool of_draws;  ///< of GL_ARB_shader_draw_parameters, which glslang has from 4.40 on
};

constexpr std::array kBuiltIns = {
    BuiltIn{"gl_DepthRange", "DepthRange", false}, BuiltIn{"gl_NumSamples", "int", false},
    BuiltIn{"gl_DrawIDARB", "int", true},          BuiltIn{"gl_BaseVertexARB", "int", true},
    BuiltIn{"gl_BaseInstanceARB", "int", true},    BuiltIn{"gl_ClipVertex", "vec4", false},
};

/// `own` is the version that the stage states, the prologue's the one that glslang is to read it as.
bool has(const BuiltIn& built_in, StageKind stage, const std::string& prologue, const GlslVersion& own) {
    const GlslVersion version = version_of(prologue);
    if (built_in.of_draws)
        return stage == StageKind::vertex && !version.es && version.number < 440 &&
               prologue.find("GL_ARB_shader_draw_parameters ") != std::string::npos;
    if (built_in.name == "gl_ClipVertex")
        return stage == StageKind::vertex && !own.es && (own.number < 140 || own.profile == "compatibility");
    if (built_in.name == "gl_NumSamples")
        return stage == StageKind::fragment && version.number >= (version.es ? 320 : 400);
    return true;
}

std::string own_name(std::string_view name) {
    return fmt::format("{}{}", kOwnPrefix, name.substr(3));
}

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

void replace_all(std::string& text, std::string_view old, std::string_view by) {
    for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
        text.replace(at, old.size(), by);
}

/// Empty where the name is no macro of the version.
std::string_view name_for_glslang(std::string_view name) {
    for (const auto& [own, other] : kVersionMacros)
        if (own == name) return other;
    return {};
}

/// What asks for an extension, or defines such a macro itself, which no compiler takes.
bool keeps_its_names(std::string_view line) {
    const std::vector<std::string_view> tokens = tokens_of(line);
    if (tokens.size() < 3 || tokens[0] != "#") return false;
    const bool is_definition = tokens[1] == "define" || tokens[1] == "undef";
    return tokens[1] == "extension" || (is_definition && is_foreign_macro(tokens[2]));
}

}  // namespace

MissingBuiltIns missing_built_ins(StageKind stage, const std::string& prologue,
                                  const std::vector<const Piece*>& pieces) {
    MissingBuiltIns found;
    const GlslVersion own = version_of(pieces.front()->text);
    for (const BuiltIn& built_in : kBuiltIns) {
        const auto mentions = [&](const Piece* piece) { return contains(piece->text, built_in.name); };
        if (!has(built_in, stage, prologue, own) || std::ranges::none_of(pieces, mentions)) continue;
        const std::string name = own_name(built_in.name);
        if (built_in.type == "DepthRange") {
            found.renamed.emplace_back("gl_DepthRangeParameters", name + "Parameters");
            found.declarations += fmt::format(
                "struct {0}Parameters {{ highp float near, far, diff; }}; uniform {0}Parameters {0};\n",
                name);
        } else if (built_in.name == "gl_ClipVertex") {
            found.declarations += fmt::format("vec4 {};\n", name);  // written, and read by the clip planes
        } else {
            found.declarations += fmt::format("uniform highp {} {};\n", built_in.type, name);
        }
        found.renamed.emplace_back(built_in.name, name);
    }
    // OpenGL ES 2 has it by the extension; what is read as another version has it without.
    if (stage == StageKind::fragment && own.es && !makes_spirv(own) &&
        contains(prologue, "GL_EXT_frag_depth "))
        found.renamed.emplace_back("gl_FragDepthEXT", "gl_FragDepth");
    return found;
}

bool is_missing_built_in(std::string_view uniform) {
    return uniform.starts_with(kOwnPrefix);
}

std::string without_foreign_macros(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        const std::size_t size = std::min(line.size() + 1, text.size());
        Substitutions renamed;
        if (line.find("GL_") != std::string_view::npos && !keeps_its_names(line))
            for (const std::string_view name : identifiers_of(line))
                if (is_foreign_macro(name))
                    renamed.emplace_back(name, fmt::format("{}{}", kUndefinedPrefix, name));
        result += renamed.empty() ? text.substr(0, size) : substituted(text.substr(0, size), renamed);
        text.remove_prefix(size);
    }
    return result;
}

std::string driver_declarations(const std::string& prologue, const std::vector<const Piece*>& pieces) {
    const GlslVersion version = version_of(prologue);
    const bool has_fma =
        !version.es && version.number < 400 && prologue.find("GL_ARB_gpu_shader5 ") != std::string::npos &&
        std::ranges::any_of(pieces, [](const Piece* piece) { return contains(piece->text, "fma"); });
    std::string text = fmt::format("#define {} 1\n", kDefinedByDrivers);
    for (const std::string& macro : version_macros(version_of(pieces.front()->text))) {
        const std::size_t end = macro.find(' ');
        text += fmt::format("#define {}{}\n", name_for_glslang(macro.substr(0, end)), macro.substr(end));
    }
    for (const char* type : {"float", "vec2", "vec3", "vec4"})
        if (has_fma) text += fmt::format("{0} fma({0} a, {0} b, {0} c) {{ return a * b + c; }}\n", type);
    return text;
}

std::string with_driver_macros(std::string_view text) {
    if (!contains(text, "GL_") && !contains(text, "__VERSION__")) return std::string(text);
    std::string result;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view line = rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1);
        rest.remove_prefix(line.size());
        const std::vector<std::string_view> tokens = tokens_of(line);
        const bool is_condition =
            tokens.size() > 2 && tokens[0] == "#" && (tokens[1].starts_with("if") || tokens[1] == "elif");
        const bool is_definition =
            tokens.size() > 2 && tokens[0] == "#" && (tokens[1] == "define" || tokens[1] == "undef");
        Substitutions known;
        for (const std::string_view name : tokens) {
            if (is_condition && is_unknown_to_glslang(name)) known.emplace_back(name, kDefinedByDrivers);
            const std::string_view other = name_for_glslang(name);
            if (!other.empty() && !(is_definition && tokens[2] == name)) known.emplace_back(name, other);
        }
        result += known.empty() ? std::string(line) : substituted(line, known);
    }
    return without_foreign_macros(result);
}

std::string without_own_layouts(std::string text) {
    for (std::size_t at = text.find("layout"); at != std::string::npos; at = text.find("layout", at + 1)) {
        const std::size_t open = text.find_first_not_of(" \t\n", at + 6);
        if (open == std::string::npos || text[open] != '(') continue;
        const std::size_t end = std::min(text.find(')', open), text.size());
        for (const std::string_view word : {"shared", "packed"})
            if (const std::size_t found = text.find(word, open);
                found < end && !is_identifier_part(text[found - 1]) &&
                !is_identifier_part(text[found + word.size()]))
                text.replace(found, word.size(), "column_major");
    }
    return text;
}

std::string without_formats(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t at = text.find("layout");
        const std::size_t open = text.find('(', std::min(at, text.size()));
        const std::size_t end = text.find(')', std::min(open, text.size()));
        if (end == std::string_view::npos) break;
        const std::string_view list = text.substr(open + 1, end - open - 1);
        std::vector<std::string> kept = split(list, ',');
        const auto removed =
            std::erase_if(kept, [](const std::string& word) { return is_image_format(trim(word)); });
        if (removed == 0)
            result += text.substr(0, end + 1);
        else
            result += std::string(text.substr(0, at)) +
                      (kept.empty() ? "" : fmt::format("layout({})", join(kept, ",")));
        text.remove_prefix(end + 1);
    }
    return result + std::string(text);
}

bool is_image_format(std::string_view word) {
    if (!word.starts_with('r')) return false;
    for (const std::string_view format :
         {"rgba32f",     "rgba16f",    "rg32f",     "rg16f",     "r11f_g11f_b10f",
          "r32f",        "r16f",       "rgba16",    "rgb10_a2",  "rgba8",
          "rg16",        "rg8",        "r16",       "r8",        "rgba16_snorm",
          "rgba8_snorm", "rg16_snorm", "rg8_snorm", "r16_snorm", "r8_snorm",
          "rgba32i",     "rgba16i",    "rgba8i",    "rg32i",     "rg16i",
          "rg8i",        "r32i",       "r16i",      "r8i",       "rgba32ui",
          "rgba16ui",    "rgb10_a2ui", "rgba8ui",   "rg32ui",    "rg16ui",
          "rg8ui",       "r32ui",      "r16ui",     "r8ui"})
        if (word == format) return true;
    return false;
}

bool are_of_formats(const Diagnostics& found) {
    return exit_status(found) != 0 && std::ranges::all_of(found, [](const Diagnostic& one) {
               return one.severity != Severity::error ||
                      one.message.starts_with("'format' : image formats must match");
           });
}

bool differs_from_drivers(std::string_view text) {
    return contains(text, "GL_") || contains(text, "__VERSION__") || contains(text, "shared") ||
           contains(text, "packed");
}

void name_built_ins(Diagnostic& diagnostic) {
    replace_all(diagnostic.message, kOwnPrefix, "gl_");
    replace_all(diagnostic.message, kUndefinedPrefix, "");
    for (const auto& [own, other] : kVersionMacros) replace_all(diagnostic.message, other, own);
}

}  // namespace gobo
