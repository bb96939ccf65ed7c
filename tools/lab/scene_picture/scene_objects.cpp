#include "lab/scene_picture/scene_objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "lab/scene_picture/posed_mesh.hpp"
#include "scene/material_extensions.hpp"

namespace gobo::scene {
namespace {

/// The blocks that a scene fills, besides those of the extensions of its materials.
constexpr std::array kSceneBlocks = {
    "Material",
    "Ambient",
    "DirectionalLights",
    "PointLights",
    "SpotLights",
    "Toon",
    "Fog",
    "Cutout",
    "Shadows",
    "Hemisphere",
    "Harmonics",
    "ImageLight",
    "Reflection",
    "TexturePlacements",
};

/// Whether the value is of a block that a scene fills.
bool is_of_scene(const RenderValue& value) {
    const std::string head = value.name.substr(0, value.name.find('.'));
    if (std::ranges::find(kSceneBlocks, head) != kSceneBlocks.end()) return true;
    return std::ranges::any_of(material_extensions(), [&](const MaterialExtension& extension) {
        return std::string_view(extension.properties.front().uniform).starts_with(head + ".");
    });
}

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

glm::dvec3 position_of(const Scene& scene, const PlacedLight& placed) {
    return glm::dvec3(scene.nodes[placed.node].world[3]);
}

void add_light(const PlacedLight& placed, const glm::dvec3& position, const std::string& name,
               Values& values) {
    const Light& light = *placed.light;
    values.set(name + ".color", light.color);
    if (light.kind == LightKind::directional)
        return values.set_direction(name + ".direction", -placed.direction);
    values.set(name + ".position", position, "eye_point");
    values.set(name + ".attenuation", light.attenuation);
    if (light.kind != LightKind::spot) return;
    values.set(name + ".exponent", light.exponent);
    values.set(name + ".innerOneMinusCosine", one_minus_cosine(light.inner_angle));
    values.set(name + ".outerOneMinusCosine", one_minus_cosine(light.outer_angle));
    values.set_direction(name + ".axis", placed.direction);
}

bool receives_shadow(const Draw& draw, const PlacedLight& light) {
    return std::any_of(draw.effects.begin(), draw.effects.end(), [&](const Effect& effect) {
        return effect.is_in && effect.name == "shadow of " + light.label;
    });
}

/// The lights that are in, by their number among those of the scene, in the order of the draw's blocks: those
/// whose shadows are in come first.
std::vector<std::size_t> lights_in_order(const Draw& draw, const std::vector<PlacedLight>& lights) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (draw.effects[i].is_in) order.push_back(i);
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return receives_shadow(draw, lights[i]); });
    return order;
}

void add_lights(const Scene& scene, const Draw& draw, Values& values) {
    constexpr std::array blocks = {"DirectionalLights", "PointLights", "SpotLights"};
    std::array<int, blocks.size()> counts{};
    const std::vector<PlacedLight> lights = place_lights(scene);
    for (const std::size_t i : lights_in_order(draw, lights)) {
        const auto kind = static_cast<std::size_t>(lights[i].light->kind);
        add_light(lights[i], position_of(scene, lights[i]),
                  fmt::format("{}.lights[{}]", blocks[kind], counts[kind]++), values);
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
    values.set("Reflection.roughestLevel", static_cast<double>(kRoughnessLevels - 1));
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

ShadowLight shadow_light(const Scene& scene, const PlacedLight& placed) {
    switch (placed.light->kind) {
        case LightKind::directional:
            return {ShadowLight::Kind::directional, glm::dvec3(0), -placed.direction, 0};
        case LightKind::spot:
            return {ShadowLight::Kind::spot, position_of(scene, placed), placed.direction,
                    placed.light->outer_angle};
        case LightKind::point:
            break;
    }
    return {ShadowLight::Kind::point, position_of(scene, placed), glm::dvec3(0), 0};
}

/// The lights whose shadows the draw receives, as they stand in its blocks.
std::vector<std::size_t> shadowing(const Draw& draw, const std::vector<PlacedLight>& lights) {
    std::vector<std::size_t> result;
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
        for (const std::size_t i : lights_in_order(draw, lights))
            if (lights[i].light->kind == kind && receives_shadow(draw, lights[i])) result.push_back(i);
    return result;
}

}  // namespace

Object object_of(const Scene& scene, const Draw& draw) {
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
    PosedMesh posed = posed_mesh(scene, draw.node, primitive_of(scene, draw));
    if (posed.mesh.texcoords1.empty()) posed.mesh.texcoords1.resize(posed.mesh.positions.size());
    if (posed.mesh.tangents.empty()) posed.mesh.tangents.resize(posed.mesh.positions.size());
    Object object{std::move(posed.mesh), posed.model, std::move(values.list)};
    object.culls_back_faces = !material.double_sided;
    return object;
}

std::vector<RenderValue> values_beside_scene(const std::vector<RenderValue>& family_values) {
    std::vector<RenderValue> values = family_values;
    std::erase_if(values, is_of_scene);
    return values;
}

SceneImages images_of(const Scene& scene, const std::vector<Draw>& draws) {
    const std::vector<PlacedLight> lights = place_lights(scene);
    SceneImages images;
    std::vector<std::size_t> number(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const bool is_wanted = std::any_of(draws.begin(), draws.end(), [&](const Draw& draw) {
            return draw.excluded.empty() && receives_shadow(draw, lights[i]);
        });
        if (!is_wanted) continue;
        number[i] = images.lights.size();
        images.lights.push_back(shadow_light(scene, lights[i]));
    }
    for (const Draw& draw : draws) {
        images.opacity.emplace_back();
        std::vector<std::size_t>& own = images.shadows.emplace_back();
        auto& pictures = images.pictures.emplace_back();
        images.are_blended.push_back(false);
        if (!draw.excluded.empty()) continue;
        if (scene.is_physical) {
            constexpr std::array samplers = {"baseColorMap", "metallicRoughnessMap", "normalMap",
                                             "occlusionMap", "emissiveMap"};
            const Material& material = material_of(scene, draw);
            images.are_blended.back() = material.alpha_mode == AlphaMode::blend;
            for (std::size_t map = 0; map < samplers.size(); ++map)
                if (const auto& use = material.physical.maps[map])
                    pictures[samplers[map]] = {&scene.pictures[use->picture], &*use, map == 0 || map == 4};
        }
        images.opacity.back() = material_of(scene, draw).opacity.value_or(AlphaMap());
        for (const std::size_t light : shadowing(draw, lights)) own.push_back(number[light]);
    }
    return images;
}

std::vector<RenderValue> shadow_values(const std::vector<RenderValue>& of_all,
                                       const std::vector<std::size_t>& lights) {
    std::vector<RenderValue> values;
    for (std::size_t place = 0; place < lights.size(); ++place) {
        const std::string of_light = fmt::format("Shadows.shadows[{}].", lights[place]);
        for (RenderValue value : of_all) {
            if (!value.name.starts_with(of_light)) continue;
            value.name = fmt::format("Shadows.shadows[{}].{}", place, value.name.substr(of_light.size()));
            values.push_back(std::move(value));
        }
    }
    return values;
}

}  // namespace gobo::scene
