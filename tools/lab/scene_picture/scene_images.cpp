#include "lab/scene_picture/scene_images.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "scene/light_reach.hpp"
#include "lab/scene_picture/scene_object.hpp"

namespace gobo::scene {
namespace {

constexpr LightKind order_of_kinds[] = {LightKind::directional, LightKind::spot, LightKind::point};

bool receives_shadow(const Draw& draw, const PlacedLight& light) {
    return std::any_of(draw.effects.begin(), draw.effects.end(), [&](const Effect& effect) {
        return effect.is_in && effect.name == "shadow of " + light.label;
    });
}

ShadowLight shadow_light(const Scene& scene, const PlacedLight& placed) {
    const glm::dvec3 position(scene.nodes[static_cast<std::size_t>(placed.node)].world[3]);
    switch (placed.light->kind) {
        case LightKind::directional:
            return {ShadowLight::Kind::directional, glm::dvec3(0), -placed.direction, 0};
        case LightKind::spot:
            return {ShadowLight::Kind::spot, position, placed.direction, placed.light->outer_angle};
        case LightKind::point:
            break;
    }
    return {ShadowLight::Kind::point, position, glm::dvec3(0), 0};
}

/// The lights whose shadows the draw receives, as they stand in its blocks.
std::vector<std::size_t> shadowing(const Draw& draw, const std::vector<PlacedLight>& lights) {
    std::vector<std::size_t> result;
    for (const LightKind kind : order_of_kinds)
        for (const std::size_t i : lights_in_order(draw, lights))
            if (lights[i].light->kind == kind && receives_shadow(draw, lights[i])) result.push_back(i);
    return result;
}

}  // namespace

SceneImages images_of(const Scene& scene, const std::vector<Draw>& draws) {
    const std::vector<PlacedLight> lights = place_lights(scene);
    SceneImages images;
    std::vector<std::optional<std::size_t>> number(lights.size());
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
        if (!draw.excluded.empty()) continue;
        images.opacity.back() = material_of(scene, draw).opacity.value_or(AlphaMap());
        for (const std::size_t light : shadowing(draw, lights)) own.push_back(*number[light]);
    }
    return images;
}

std::vector<RenderValue> shadow_values(const ShadowPlan& plan, const std::vector<std::size_t>& lights) {
    std::vector<RenderValue> values;
    for (std::size_t place = 0; place < lights.size(); ++place) {
        const std::string of_light = fmt::format("Shadows.shadows[{}].", lights[place]);
        for (const RenderValue& value : plan.values) {
            if (!value.name.starts_with(of_light)) continue;
            RenderValue own = value;
            own.name = fmt::format("Shadows.shadows[{}].{}", place, value.name.substr(of_light.size()));
            values.push_back(std::move(own));
        }
    }
    return values;
}

}  // namespace gobo::scene
