#include "scene/draw_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace gobo::scene {
namespace {

/// The values of an object, as they are added.
class Values {
  public:
    void set(std::string name, std::vector<double> numbers, std::string source = "") {
        list.push_back({std::move(name), std::move(source), std::move(numbers), {}});
    }
    void set(std::string name, double number) { set(std::move(name), std::vector{number}); }
    void set(std::string name, const glm::dvec3& vector, std::string source = "") {
        set(std::move(name), std::vector{vector.x, vector.y, vector.z}, std::move(source));
    }
    /// A unit vector of world space, given in eye space. A zero one has no direction there either.
    void set_direction(std::string name, const glm::dvec3& vector) {
        set(std::move(name), vector, vector == glm::dvec3(0) ? "" : "eye_direction");
    }
    /// A value that the renderer knows by itself.
    void set_source(std::string name, std::string source) {
        set(std::move(name), std::vector<double>(), std::move(source));
    }
    std::vector<RenderValue> list;
};

/// 1 - cos of an angle, without the cancellation at small ones.
double one_minus_cosine(double angle) {
    const double sine = std::sin(angle / 2);
    return 2 * sine * sine;
}

void add_light(const Scene& scene, const PlacedLight& placed, const std::string& name, Values& values) {
    const Light& light = *placed.light;
    values.set(name + ".color", light.color);
    if (light.kind == LightKind::directional)
        return values.set_direction(name + ".direction", -placed.direction);
    const glm::dvec3 position(scene.nodes[placed.node].world[3]);
    if (scene.is_physical)  // w is 1 / range
        values.set(name + ".position", {position.x, position.y, position.z, 1 / light.range},
                   "eye_point_and");
    else
        values.set(name + ".position", position, "eye_point");
    values.set(name + ".attenuation", light.attenuation);
    if (light.kind != LightKind::spot) return;
    values.set(name + ".exponent", light.exponent);
    values.set(name + ".innerOneMinusCosine", one_minus_cosine(light.inner_angle));
    values.set(name + ".outerOneMinusCosine", one_minus_cosine(light.outer_angle));
    values.set_direction(name + ".axis", placed.direction);
}

void add_lights(const Scene& scene, const Draw& draw, Values& values) {
    constexpr std::array blocks = {"DirectionalLights", "PointLights", "SpotLights"};
    std::array<int, blocks.size()> counts{};
    const std::vector<PlacedLight> lights = place_lights(scene);
    for (const std::size_t i : lights_in_order(draw, lights)) {
        const auto kind = static_cast<std::size_t>(lights[i].light->kind);
        add_light(scene, lights[i], fmt::format("{}.lights[{}]", blocks[kind], counts[kind]++), values);
    }
}

void add_material(const Material& material, Values& values) {
    values.set("Material.emission", material.emission);
    values.set("Material.ambient", material.ambient);
    values.set("Material.diffuse", material.diffuse);
    values.set("Material.specular", material.specular);
    values.set("Material.strength", material.strength);
    values.set("Material.shininess", material.shininess);
    if (material.alpha_mode != AlphaMode::mask || material.alpha == 0) return;
    // The base colour's alpha scales what the shader compares.
    values.set("Cutout.threshold", std::min(material.alpha_cutoff / material.alpha, 1.0));
}

/// The block of templates/pbr.toml, from glTF's factors.
void add_physical_material(const Material& material, Values& values) {
    const PhysicalMaterial& physical = material.physical;
    const glm::dvec4& base = physical.base_color;
    const bool has_alpha = material.alpha_mode != AlphaMode::opaque;
    values.set("Material.baseColor", std::vector{base.r, base.g, base.b, has_alpha ? base.a : 1});
    values.set("Material.emission", material.emission);
    values.set("Material.metallic", physical.metallic);
    values.set("Material.roughness", physical.roughness);
    values.set("Material.dielectric", physical.dielectric);
    values.set("Material.dielectricEdge", physical.dielectric_edge);
    for (const auto& [uniform, numbers] : physical.of_extensions) values.set(uniform, numbers);
    values.set("Material.normalScale", physical.normal_scale);
    values.set("Material.occlusionStrength", physical.occlusion_strength);
    values.set("Cutout.threshold", std::min(material.alpha_cutoff, 1.0));
    for (std::size_t map = 0; map < physical.maps.size(); ++map) {
        const TextureUse use = physical.maps[map].value_or(TextureUse());
        const std::string name = fmt::format("TexturePlacements.maps[{}]", map);
        values.set(name + ".linear", std::vector{use.linear[0], use.linear[1], use.linear[2], use.linear[3]});
        values.set(name + ".offset", std::vector{use.offset.x, use.offset.y});
        values.set(name + ".set", static_cast<double>(use.set));
    }
    values.set_source("texcoord1", "texcoord1");
    values.set_source("tangent", "tangent");
}

void add_overrides(const Scene& scene, const Overrides& overrides, Values& values) {
    values.set("Toon.levels", static_cast<double>(std::max(overrides.toon_levels.value_or(1), 1)));
    if (overrides.fog) {
        values.set("Fog.color", overrides.fog->color);
        values.set("Fog.density", overrides.fog->density);
        values.set("Fog.start", overrides.fog->near);
        values.set("Fog.end", overrides.fog->far);
    }
    values.set("ImageLight.color", scene.ambient);
    values.set_source("ImageLight.toMap", "inverse_view");
    values.set_source("Reflection.toMap", "inverse_view");
    values.set("Reflection.weight", overrides.reflection.value_or(0));
    if (!overrides.probe) return;
    const Probe& probe = *overrides.probe;
    values.set("ImageLight.weight", probe.share);
    values.set_direction("Hemisphere.up", probe.up);
    values.set("Hemisphere.sky", probe.sky);
    values.set("Hemisphere.ground", probe.ground);
    values.set_source("Harmonics.toProbe", "inverse_view");
    values.set("Harmonics.scale", probe.scale);
    for (std::size_t i = 0; i < probe.coefficients.size(); ++i)
        values.set(fmt::format("Harmonics.coefficients[{}]", i), probe.coefficients[i]);
}

}  // namespace

bool receives_shadow(const Draw& draw, const PlacedLight& light) {
    return std::any_of(draw.effects.begin(), draw.effects.end(), [&](const Effect& effect) {
        return effect.is_in && effect.name == "shadow of " + light.label;
    });
}

std::vector<std::size_t> lights_in_order(const Draw& draw, const std::vector<PlacedLight>& lights) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (draw.effects[i].is_in) order.push_back(i);
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return receives_shadow(draw, lights[i]); });
    return order;
}

std::vector<RenderValue> values_of_draw(const Scene& scene, const Draw& draw) {
    const Material& material = material_of(scene, draw);
    Values values;
    if (scene.is_physical)
        add_physical_material(material, values);
    else
        add_material(material, values);
    add_overrides(scene, overrides_of(scene, draw), values);
    values.set_source("color", "color");
    values.set_source("texcoord", "texcoord");
    values.set("Ambient.color", scene.ambient);
    add_lights(scene, draw, values);
    return std::move(values.list);
}

}  // namespace gobo::scene
