#include "lab/scene_picture/scene_object.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lab/scene_picture/posed_mesh.hpp"

namespace gobo::scene {
namespace {

/// The blocks that a scene fills.
constexpr std::array scene_blocks = {
    "Material", "Ambient", "DirectionalLights", "PointLights", "SpotLights", "Toon",       "Fog",
    "Cutout",   "Shadows", "Hemisphere",        "Harmonics",   "ImageLight", "Reflection",
};

class Values {
  public:
    void set(std::string name, std::vector<double> numbers, std::string source = "") {
        list.push_back({std::move(name), std::move(source), std::move(numbers), {}});
    }
    void set(std::string name, const glm::dvec3& vector, std::string source = "") {
        set(std::move(name), std::vector<double>{vector.x, vector.y, vector.z}, std::move(source));
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
double versine(double angle) {
    const double sine = std::sin(angle / 2);
    return 2 * sine * sine;
}

void add_light(const PlacedLight& placed, const glm::dvec3& position, const std::string& name,
               Values& values) {
    const Light& light = *placed.light;
    values.set(name + ".color", light.color);
    if (light.kind == LightKind::directional) {
        values.set_direction(name + ".direction", -placed.direction);
        return;
    }
    values.set(name + ".position", position, "eye_point");
    values.set(name + ".attenuation", light.attenuation);
    if (light.kind != LightKind::spot) return;
    values.set(name + ".exponent", std::vector{light.exponent});
    values.set(name + ".innerVersine", std::vector{versine(light.inner_angle)});
    values.set(name + ".outerVersine", std::vector{versine(light.outer_angle)});
    values.set_direction(name + ".axis", placed.direction);
}

std::string_view block_of(LightKind kind) {
    if (kind == LightKind::directional) return "DirectionalLights";
    return kind == LightKind::point ? "PointLights" : "SpotLights";
}

void add_lights(const Scene& scene, const Draw& draw, Values& values) {
    std::array<int, 3> counts{};
    const std::vector<PlacedLight> lights = place_lights(scene);
    for (const std::size_t i : lights_in_order(draw, lights)) {
        const LightKind kind = lights[i].light->kind;
        const int number = counts[static_cast<std::size_t>(kind)]++;
        const glm::dvec3 position(scene.nodes[static_cast<std::size_t>(lights[i].node)].world[3]);
        add_light(lights[i], position, fmt::format("{}.lights[{}]", block_of(kind), number), values);
    }
}

void add_material(const Material& material, Values& values) {
    values.set("Material.emission", material.emission);
    values.set("Material.ambient", material.ambient);
    values.set("Material.diffuse", material.diffuse);
    values.set("Material.specular", material.specular);
    values.set("Material.strength", std::vector{material.strength});
    values.set("Material.shininess", std::vector{material.shininess});
}

void add_cutout(const Material& material, Values& values) {
    if (material.alpha_mode != AlphaMode::mask || material.alpha == 0) return;
    // The base colour's alpha scales what the shader compares.
    values.set("Cutout.threshold", std::vector{std::min(material.alpha_cutoff / material.alpha, 1.0)});
}

void add_probe(const Scene& scene, const Wishes& wishes, Values& values) {
    values.set("ImageLight.color", scene.ambient);
    values.set_source("ImageLight.toMap", "inverse_view");
    values.set_source("Reflection.toMap", "inverse_view");
    values.set("Reflection.share", std::vector{wishes.reflection.value_or(0)});
    if (!wishes.probe) return;
    const Probe& probe = *wishes.probe;
    values.set("ImageLight.share", std::vector{probe.share});
    values.set_direction("Hemisphere.up", probe.up);
    values.set("Hemisphere.sky", probe.sky);
    values.set("Hemisphere.ground", probe.ground);
    values.set_source("Harmonics.toProbe", "inverse_view");
    values.set("Harmonics.scale", std::vector{probe.scale});
    for (std::size_t i = 0; i < probe.coefficients.size(); ++i)
        values.set(fmt::format("Harmonics.coefficients[{}]", i), probe.coefficients[i]);
}

void add_wishes(const Wishes& wishes, Values& values) {
    values.set("Toon.levels", std::vector{static_cast<double>(std::max(wishes.toon_levels.value_or(1), 1))});
    if (!wishes.fog) return;
    values.set("Fog.color", wishes.fog->color);
    values.set("Fog.density", std::vector{wishes.fog->density});
    values.set("Fog.near", std::vector{wishes.fog->near});
    values.set("Fog.far", std::vector{wishes.fog->far});
}

}  // namespace

std::vector<std::size_t> lights_in_order(const Draw& draw, const std::vector<PlacedLight>& lights) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (draw.effects[i].is_in) order.push_back(i);
    std::stable_partition(order.begin(), order.end(), [&](std::size_t i) {
        return std::any_of(draw.effects.begin(), draw.effects.end(), [&](const Effect& effect) {
            return effect.is_in && effect.name == "shadow of " + lights[i].label;
        });
    });
    return order;
}

std::vector<RenderValue> values_of(const Scene& scene, const Draw& draw) {
    Values values;
    const Wishes wishes = wishes_of(scene, draw);
    add_material(material_of(scene, draw), values);
    add_cutout(material_of(scene, draw), values);
    add_wishes(wishes, values);
    add_probe(scene, wishes, values);
    values.set_source("color", "color");
    values.set_source("texcoord", "texcoord");
    values.set("Ambient.color", scene.ambient);
    add_lights(scene, draw, values);
    return values.list;
}

Object object_of(const Scene& scene, const Draw& draw) {
    PosedMesh posed = posed_mesh(scene, draw.node, primitive_of(scene, draw));
    Object object{std::move(posed.mesh), posed.model, values_of(scene, draw)};
    object.culls_back_faces = !material_of(scene, draw).double_sided;
    return object;
}

std::vector<RenderValue> values_beside_scene(const std::vector<RenderValue>& family_values) {
    std::vector<RenderValue> values = family_values;
    std::erase_if(values, [](const RenderValue& value) {
        const std::string head = value.name.substr(0, value.name.find('.'));
        return std::find(scene_blocks.begin(), scene_blocks.end(), head) != scene_blocks.end();
    });
    return values;
}

}  // namespace gobo::scene
