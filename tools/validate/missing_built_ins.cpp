#include "validate/missing_built_ins.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "compose/language_names.hpp"
#include "compose/scan_piece.hpp"
#include "compose/tokens.hpp"

namespace gobo {
namespace {

constexpr std::string_view kOwnPrefix = "gobo_built_in_";
constexpr std::string_view kUndefinedPrefix = "gobo_undefined_";

struct BuiltIn {
    std::string_view name;
    std::string_view type;
    bool of_draws;  ///< of GL_ARB_shader_draw_parameters, which glslang has from 4.40 on
};

constexpr std::array kBuiltIns = {
    BuiltIn{"gl_DepthRange", "DepthRange", false}, BuiltIn{"gl_NumSamples", "int", false},
    BuiltIn{"gl_DrawIDARB", "int", true},          BuiltIn{"gl_BaseVertexARB", "int", true},
    BuiltIn{"gl_BaseInstanceARB", "int", true},
};

bool has(const BuiltIn& built_in, StageKind stage, const std::string& prologue) {
    const GlslVersion version = version_of(prologue);
    if (built_in.of_draws)
        return stage == StageKind::vertex && !version.es && version.number < 440 &&
               prologue.find("GL_ARB_shader_draw_parameters ") != std::string::npos;
    if (built_in.name == "gl_NumSamples")
        return stage == StageKind::fragment && version.number >= (version.es ? 320 : 400);
    return true;
}

std::string own_name(std::string_view name) {
    return fmt::format("{}{}", kOwnPrefix, name.substr(3));
}

void replace_all(std::string& text, std::string_view old, std::string_view by) {
    for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
        text.replace(at, old.size(), by);
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
    for (const BuiltIn& built_in : kBuiltIns) {
        const bool is_mentioned = std::ranges::any_of(
            pieces, [&](const Piece* piece) { return piece->text.find(built_in.name) != std::string::npos; });
        if (!is_mentioned || !has(built_in, stage, prologue)) continue;
        const std::string name = own_name(built_in.name);
        if (built_in.type == "DepthRange") {
            found.renamed.emplace_back("gl_DepthRangeParameters", name + "Parameters");
            found.declarations += fmt::format(
                "struct {0}Parameters {{ highp float near, far, diff; }}; uniform {0}Parameters {0};\n",
                name);
        } else {
            found.declarations += fmt::format("uniform highp {} {};\n", built_in.type, name);
        }
        found.renamed.emplace_back(built_in.name, name);
    }
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

void name_built_ins(Diagnostic& diagnostic) {
    replace_all(diagnostic.message, kOwnPrefix, "gl_");
    replace_all(diagnostic.message, kUndefinedPrefix, "");
}

}  // namespace gobo
