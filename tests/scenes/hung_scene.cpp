#include "hung_scene.hpp"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scene_library.hpp"

namespace gobo::scene {
namespace {

void hang(Scene& scene, const Light& light, const glm::dvec3& position, const glm::dvec3& target) {
    Node node;
    node.light = scene.lights.size();
    node.local = node.world = glm::inverse(glm::lookAt(position, target, glm::dvec3(0.1, 1, 0.2)));
    node.in_scene = true;
    scene.lights.push_back(light);
    scene.order.push_back(scene.nodes.size());
    scene.nodes.push_back(node);
}

Light light_of(LightKind kind, const glm::dvec3& color) {
    Light light;
    light.kind = kind;
    light.color = color;
    light.outer_angle = 0.6;
    light.inner_angle = 0.2;
    return light;
}

}  // namespace

Scene hung_scene(const std::string& file) {
    Scene scene = shipped_scene(file);
    if (!place_lights(scene).empty()) return scene;
    Box bounds;
    for (const Draw& draw : required_effects(scene, {}, {}))
        if (draw.bounds) bounds.add(*draw.bounds);
    if (bounds.is_empty()) return scene;
    const glm::dvec3 middle = (bounds.low + bounds.high) / 2.0;
    const double size = glm::length(bounds.high - bounds.low);
    const double fade = size * size;  // so that light fades with distance as in a scene of size 1
    scene.ambient = glm::dvec3(0.05);
    hang(scene, light_of(LightKind::directional, glm::dvec3(0.5, 0.4, 0.3)),
         middle + size * glm::dvec3(1, 2, 1), middle);
    hang(scene, light_of(LightKind::point, glm::dvec3(0.2, 0.4, 0.6) * fade),
         middle + size * glm::dvec3(-0.6, 0.5, 0.7), middle);
    hang(scene, light_of(LightKind::spot, glm::dvec3(0.7) * fade), middle + size * glm::dvec3(0.4, 0.8, 0.9),
         middle);
    return scene;
}

std::vector<Vantage> vantages(const Scene& scene, std::size_t count, int width, int height) {
    std::vector<Vantage> result;
    for (std::size_t camera = 0; camera < scene.cameras.size() && result.size() < count; ++camera) {
        const auto view = view_of_camera(scene, camera, width, height);
        if (view) result.push_back({eye_of_cameras(scene, camera)->low, *view});
    }
    const auto draws = required_effects(scene, {}, {});
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (std::size_t i = 0; result.size() < count; ++i) {
        const double y = 1 - 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        const double radius = std::sqrt(1 - y * y);
        const double angle = golden * static_cast<double>(i);
        const glm::dvec3 direction(radius * std::cos(angle), y, radius * std::sin(angle));
        SceneView view = view_of_all(draws, direction, width, height);
        view.background = background_of(scene);
        result.push_back({glm::dvec3(glm::inverse(view.view)[3]), view});
    }
    return result;
}

EyePlace eyes_of(const std::vector<Vantage>& vantages) {
    Box box;
    for (const Vantage& vantage : vantages) box.add(vantage.eye);
    return box;
}

}  // namespace gobo::scene
