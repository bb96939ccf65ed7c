#include "lab/scene_picture/scene_objects.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "lab/scene_picture/posed_mesh.hpp"
#include "scene/draw_values.hpp"
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

glm::dvec3 position_of(const Scene& scene, const PlacedLight& placed) {
    return glm::dvec3(scene.nodes[placed.node].world[3]);
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
    std::vector<RenderValue> values = values_of_draw(scene, draw);
    if (scene.is_physical)
        values.push_back({"Reflection.roughestLevel", "", {static_cast<double>(kRoughnessLevels - 1)}, {}});
    PosedMesh posed = posed_mesh(scene, draw.node, primitive_of(scene, draw));
    if (posed.mesh.texcoords1.empty()) posed.mesh.texcoords1.resize(posed.mesh.positions.size());
    if (posed.mesh.tangents.empty()) posed.mesh.tangents.resize(posed.mesh.positions.size());
    Object object{std::move(posed.mesh), posed.model, std::move(values)};
    object.culls_back_faces = !material.double_sided;
    const bool has_holes = std::ranges::any_of(
        draw.effects, [](const Effect& effect) { return effect.feature == "cutout" && effect.is_in; });
    if (has_holes) object.shadow_shape = ShadowShape::with_holes;
    if (!casts_shadow(scene, draw)) object.shadow_shape = ShadowShape::none;
    object.casts_shadow = object.shadow_shape != ShadowShape::none;
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
