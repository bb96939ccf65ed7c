#include "compose/dialect.hpp"

#include <array>

#include <fmt/format.h>

namespace gobo {
namespace {

enum class When { always, in_vertex, in_fragment };

/// A macro of the prologue. Empty text: the dialect needs none.
struct Macro {
    std::string_view name;
    std::string_view parameters;
    When when;
    std::string_view glsl450;
    std::string_view glsl330;
    std::string_view es300;
};

constexpr std::array macros = {
    Macro{"BLOCK", "binding_, name_", When::always, "layout(std140, binding = binding_) uniform name_",
          "layout(std140) uniform name_", "layout(std140) uniform name_"},
    Macro{"VARYING", "location_", When::in_vertex, "layout(location = location_) out", "out", "out"},
    Macro{"VARYING", "location_", When::in_fragment, "layout(location = location_) in", "in", "in"},
    Macro{"ATTRIBUTE", "location_", When::always, "layout(location = location_) in",
          "layout(location = location_) in", "layout(location = location_) in"},
    Macro{"OUTPUT", "location_", When::always, "layout(location = location_) out",
          "layout(location = location_) out", "layout(location = location_) out"},
    Macro{"SAMPLER", "binding_, type_", When::always, "layout(binding = binding_) uniform type_",
          "uniform type_", "uniform highp type_"},
    Macro{"DEPTH", "qualifier_", When::always, "layout(qualifier_)", "layout(qualifier_)",
          "layout(qualifier_)"},
};

/// What the DEPTH macro's qualifiers need before 4.2, where they became core.
std::string_view depth_extension(Dialect dialect, const Mentions& mentions) {
    if (dialect == Dialect::glsl450 || !mentions("DEPTH")) return "";
    if (mentions("early_fragment_tests")) return "#extension GL_ARB_shader_image_load_store : enable\n";
    return dialect == Dialect::es300 ? "#extension GL_EXT_conservative_depth : enable\n"
                                     : "#extension GL_ARB_conservative_depth : enable\n";
}

std::string_view text_for(const Macro& macro, Dialect dialect) {
    if (dialect == Dialect::glsl330) return macro.glsl330;
    return dialect == Dialect::es300 ? macro.es300 : macro.glsl450;
}

/// The dialect whose macros suit a template's own version: explicit bindings and locations came with 4.2.
Dialect spelling_of(Dialect dialect, std::string_view own_version) {
    if (dialect != Dialect::own) return dialect;
    if (own_version.find("es") != std::string_view::npos) return Dialect::es300;
    return !own_version.empty() && own_version < "420" ? Dialect::glsl330 : Dialect::glsl450;
}

std::string version_line(Dialect dialect, std::string_view own_version) {
    switch (dialect) {
        case Dialect::own:
            return fmt::format("#version {}\n", own_version.empty() ? "450 core" : own_version);
        case Dialect::glsl450:
            return "#version 450 core\n";
        case Dialect::glsl330:
            return "#version 330 core\n";
        case Dialect::es300:
            return "#version 300 es\n";
    }
    return "";
}

}  // namespace

std::string_view name_of(Dialect dialect) {
    if (dialect == Dialect::glsl330) return "330";
    return dialect == Dialect::es300 ? "es300" : "450";
}

std::optional<Dialect> dialect_of(std::string_view name) {
    if (name == "450") return Dialect::glsl450;
    if (name == "330") return Dialect::glsl330;
    if (name == "es300") return Dialect::es300;
    return std::nullopt;
}

std::string dialect_prologue(Dialect dialect, StageKind stage, std::string_view own_version,
                             const Mentions& mentions) {
    std::string text = version_line(dialect, own_version);
    const Dialect spelling = spelling_of(dialect, own_version);
    text += depth_extension(spelling, mentions);
    if (dialect == Dialect::es300) text += "precision highp float;\nprecision highp int;\n";
    for (const Macro& macro : macros) {
        const bool other_stage = (macro.when == When::in_vertex && stage != StageKind::vertex) ||
                                 (macro.when == When::in_fragment && stage != StageKind::fragment);
        if (other_stage || !mentions(macro.name)) continue;
        text += fmt::format("#define {}({}) {}\n", macro.name, macro.parameters, text_for(macro, spelling));
    }
    return text;
}

}  // namespace gobo
