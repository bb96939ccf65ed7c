#include "stage.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "lab/scene_picture/posed_mesh.hpp"
#include "lab/scene_picture/scene_objects.hpp"
#include "scene/draw_values.hpp"

namespace viewer {
namespace {

using gobo::scene::Draw;
using gobo::scene::Effect;
using gobo::scene::Scene;

lit::Material material_block(const gobo::scene::Material& material) {
    lit::Material block{};
    block.emission = glm::vec3(material.emission);
    block.ambient = glm::vec3(material.ambient);
    block.diffuse = glm::vec3(material.diffuse);
    block.specular = glm::vec3(material.specular);
    block.strength = static_cast<float>(material.strength);
    block.shininess = static_cast<float>(material.shininess);
    return block;
}

lit::Fog_block fog_block(const gobo::scene::Fog& fog) {
    lit::Fog_block block{};
    block.color = glm::vec3(fog.color);
    block.density = static_cast<float>(fog.density);
    block.start = static_cast<float>(fog.near);
    block.end = static_cast<float>(fog.far);
    return block;
}

template <class Enum>
Enum named(const std::string& name, std::initializer_list<std::pair<const char*, Enum>> names,
           Enum otherwise) {
    for (const auto& [known, value] : names)
        if (name == known) return value;
    return otherwise;
}

bool is_light(const Effect& effect) {
    return effect.feature == "directional" || effect.feature == "point" || effect.feature == "spot";
}

/// Whether the effect is one of the surface or of the light around it.
bool call_for_surface(const Effect& effect, DrawState& state) {
    if (effect.feature == "sides") state.sides = lit::Sides::two;
    if (effect.feature == "vertex_color") state.vertex_color = lit::VertexColor::modulate;
    if (effect.feature == "ambient")
        state.ambient = named(effect.value,
                              {{"hemisphere", lit::AmbientFeature::hemisphere},
                               {"spherical_harmonics", lit::AmbientFeature::spherical_harmonics}},
                              lit::AmbientFeature::global);
    return effect.feature == "sides" || effect.feature == "vertex_color" ||
           (effect.feature == "ambient" && effect.value != "image");
}

/// Whether this viewer draws the effect.
bool call_for(const Effect& effect, DrawState& state) {
    if (effect.feature == "directional") ++state.directional;
    if (effect.feature == "point") ++state.point;
    if (effect.feature == "spot") ++state.spot;
    if (effect.feature == "directional_shadows") ++state.directional_shadows;
    if (effect.feature == "point_shadows") ++state.point_shadows;
    if (effect.feature == "spot_shadows") ++state.spot_shadows;
    if (effect.feature == "diffuse")
        state.diffuse = named(effect.value, {{"toon", lit::Diffuse::toon}}, lit::Diffuse::lambert);
    if (effect.feature == "specular")
        state.specular =
            named(effect.value, {{"phong", lit::Specular::phong}, {"blinn", lit::Specular::blinn}},
                  lit::Specular::none);
    if (effect.feature == "fog")
        state.fog = named(effect.value,
                          {{"linear", lit::Fog::linear},
                           {"exponential", lit::Fog::exponential},
                           {"exponential_squared", lit::Fog::exponential_squared}},
                          lit::Fog::none);
    return is_light(effect) || effect.feature.ends_with("_shadows") || effect.feature == "diffuse" ||
           effect.feature == "specular" || effect.feature == "fog" || call_for_surface(effect, state);
}

StageDraw make_draw(const Scene& scene, const Draw& draw) {
    StageDraw result;
    result.name = draw.name;
    gobo::scene::PosedMesh posed = gobo::scene::posed_mesh(scene, draw.node, primitive_of(scene, draw));
    result.mesh = std::move(posed.mesh);
    result.model = posed.model;
    result.double_sided = material_of(scene, draw).double_sided;
    result.material = material_block(material_of(scene, draw));
    const gobo::scene::Overrides overrides = overrides_of(scene, draw);
    if (overrides.fog) result.fog = fog_block(*overrides.fog);
    result.probe = overrides.probe.value_or(gobo::scene::Probe());
    if (draw.bounds) result.middle = (draw.bounds->low + draw.bounds->high) / 2.0;
    if (scene.is_physical) result.physical = physical_draw_of(scene, draw);
    result.toon.levels = std::max(overrides.toon_levels.value_or(0), 0) > 0 ? *overrides.toon_levels : 4;
    result.lights = lights_in_order(draw, place_lights(scene));
    for (const Effect& effect : draw.effects) {
        if (!effect.is_in) continue;
        const bool is_drawn = result.physical ? viewer::call_for(effect, result.physical->state)
                                              : call_for(effect, result.state);
        if (!is_drawn) result.not_drawn.push_back(effect.name);
    }
    return result;
}

}  // namespace

gobo::Result<Stage> read_stage(const gobo::FileSystem& files, const std::string& path,
                               gobo::scene::Reading reading) {
    gobo::Result<Scene> scene = gobo::scene::read_scene(files, path, reading);
    if (!scene) return tl::unexpected(scene.error());
    Stage stage;
    stage.scene = std::move(*scene);
    gobo::scene::Box bounds;
    const std::vector<Draw> draws = gobo::scene::required_effects(stage.scene, {}, {});
    const gobo::scene::SceneImages images = images_of(stage.scene, draws);
    stage.shadow_lights = images.lights;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        if (!draws[i].excluded.empty()) continue;
        if (draws[i].bounds) bounds.add(*draws[i].bounds);
        stage.draws.push_back(make_draw(stage.scene, draws[i]));
        stage.draws.back().shadows = images.shadows[i];
    }
    if (!bounds.is_empty()) {
        stage.center = (bounds.low + bounds.high) / 2.0;
        stage.radius = std::max(glm::length(bounds.high - bounds.low) / 2, 1e-6);
    }
    return stage;
}

DrawState under(const DrawState& state, const Settings& settings) {
    DrawState result = state;
    if (!settings.directional) result.directional = result.directional_shadows = 0;
    if (!settings.point) result.point = result.point_shadows = 0;
    if (!settings.spot) result.spot = result.spot_shadows = 0;
    if (!settings.fog) result.fog = lit::Fog::none;
    if (settings.toon) result.diffuse = lit::Diffuse::toon;
    result.shading = settings.shading;
    return result;
}

}  // namespace viewer
