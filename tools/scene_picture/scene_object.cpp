#include "scene_picture/scene_object.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene_picture/posed_mesh.hpp"

namespace gobo::scene {
namespace {

/// The blocks that a scene fills.
constexpr std::array scene_blocks = {"Material", "Ambient", "DirectionalLights", "PointLights", "SpotLights",
                                     "Toon",     "Fog"};

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
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!draw.effects[i].is_in) continue;
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

void add_wishes(const Wishes& wishes, Values& values) {
    values.set("Toon.levels", std::vector{static_cast<double>(std::max(wishes.toon_levels.value_or(1), 1))});
    if (!wishes.fog) return;
    values.set("Fog.color", wishes.fog->color);
    values.set("Fog.density", std::vector{wishes.fog->density});
    values.set("Fog.near", std::vector{wishes.fog->near});
    values.set("Fog.far", std::vector{wishes.fog->far});
}

}  // namespace

std::vector<RenderValue> values_of(const Scene& scene, const Draw& draw) {
    Values values;
    add_material(material_of(scene, draw), values);
    add_wishes(wishes_of(scene, draw), values);
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
