#include <algorithm>

#include <fmt/format.h>

#include "scene/subject.hpp"

namespace gobo::scene {
namespace {

Effect flag(std::string name, std::string value, bool is_in, std::string why_in, std::string why_out) {
    Effect effect{std::move(name), "", std::move(value), is_in,
                  is_in ? std::move(why_in) : std::move(why_out)};
    effect.feature = effect.name;
    return effect;
}

/// The least and the greatest alpha that the surface may have somewhere.
Interval alpha_range(const Primitive& primitive, const Material& material) {
    Interval of_map{1, 1};
    if (material.opacity && material.opacity->texels.empty()) of_map = {0, 1};
    if (material.opacity && !material.opacity->texels.empty()) {
        const auto [low, high] =
            std::minmax_element(material.opacity->texels.begin(), material.opacity->texels.end());
        of_map = {*low / 255.0, *high / 255.0};
    }
    Interval of_vertices{1, 1};
    if (!primitive.colors.empty()) {
        of_vertices = {1, 0};
        for (const glm::vec4& color : primitive.colors) {
            of_vertices.low = std::min(of_vertices.low, static_cast<double>(color.a));
            of_vertices.high = std::max(of_vertices.high, static_cast<double>(color.a));
        }
    }
    return {material.alpha * of_map.low * of_vertices.low, material.alpha * of_map.high * of_vertices.high};
}

Effect judge_cutout(const Primitive& primitive, const Material& material) {
    Effect effect{"cutout", "cutout", "threshold", false, ""};
    const double lowest = alpha_range(primitive, material).low;
    if (material.alpha_mode != AlphaMode::mask) {
        effect.reason = "alphaMode is not MASK";
    } else if (lowest >= material.alpha_cutoff) {
        effect.reason = fmt::format("its alpha is nowhere below {:.3g}", material.alpha_cutoff);
    } else {
        effect.is_in = true;
        effect.reason = fmt::format("its alpha falls to {:.3g}, below {:.3g}", lowest, material.alpha_cutoff);
    }
    return effect;
}

Effect judge_vertex_color(const Primitive& primitive, const Material& material) {
    Effect effect{"vertex_color", "vertex_color", "modulate", false, ""};
    const bool is_alpha_read = material.alpha_mode != AlphaMode::opaque;
    const auto is_colored = [](const glm::vec4& color) { return glm::vec3(color) != glm::vec3(1); };
    const auto is_transparent = [](const glm::vec4& color) { return color.a != 1; };
    const auto any = [&](auto predicate) {
        return std::any_of(primitive.colors.begin(), primitive.colors.end(), predicate);
    };
    const bool scatters = material.diffuse != glm::dvec3(0) || material.ambient != glm::dvec3(0);
    if (primitive.colors.empty()) {
        effect.reason = "it has none";
    } else if (any(is_colored) && scatters) {
        effect.is_in = true;
        effect.reason = "its vertices have colours";
    } else if (is_alpha_read && any(is_transparent)) {
        effect.is_in = true;
        effect.reason = "its vertices are not opaque";
    } else {
        effect.reason = any(is_colored) ? "its material scatters no light" : "all are white";
    }
    return effect;
}

Effect judge_probe(const Overrides& overrides, const Material& material) {
    const std::string kind = overrides.probe ? overrides.probe->kind : "none";
    Effect effect{"probe", "ambient", kind, false, ""};
    if (kind == "none") {
        effect.reason = "not asked for";
    } else if (material.ambient == glm::dvec3(0)) {
        effect.reason = "its material gives back no ambient light";
    } else {
        effect.is_in = true;
        effect.reason = kind;
    }
    return effect;
}

Effect judge_reflection(const Overrides& overrides, const Material& material) {
    Effect effect{"reflection", "reflection", "image", false, ""};
    const double share = overrides.reflection.value_or(0);
    if (share == 0) {
        effect.reason = "not asked for";
    } else if (material.specular == glm::dvec3(0) || material.strength == 0) {
        effect.reason = "its material has no highlight";
    } else {
        effect.is_in = true;
        effect.reason = fmt::format("a share of {:.3g}", share);
    }
    return effect;
}

}  // namespace

bool is_cut_away(const Primitive& primitive, const Material& material) {
    return material.alpha_mode == AlphaMode::mask &&
           alpha_range(primitive, material).high < material.alpha_cutoff;
}

std::vector<Effect> judge_surface(const Subject& subject) {
    const Material& material = subject.material;
    std::vector<Effect> effects = {
        flag("sides", "two", material.double_sided, "its material is marked doubleSided", "not marked"),
        judge_cutout(subject.primitive, material),
        judge_vertex_color(subject.primitive, material),
        flag("texture", "on", material.is_textured, "its material has textures", "it has none"),
        judge_probe(subject.overrides, material),
        judge_reflection(subject.overrides, material)};
    for (const auto& [feature, value] : subject.overrides.quality)
        effects.push_back({feature, feature, value, true, "asked for"});
    return effects;
}

}  // namespace gobo::scene
