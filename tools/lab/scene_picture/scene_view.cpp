#include "lab/scene_picture/scene_view.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace gobo::scene {
namespace {

constexpr double usual_angle = 0.7;

/// A perspective projection; the far plane may be infinitely far.
glm::dmat4 perspective(double vertical_angle, double aspect, double near_plane, double far_plane) {
    return std::isinf(far_plane) ? glm::infinitePerspective(vertical_angle, aspect, near_plane)
                                 : glm::perspective(vertical_angle, aspect, near_plane, far_plane);
}

glm::dmat4 projection_of(const Camera& camera, double aspect) {
    if (camera.is_perspective)
        return perspective(camera.vertical_angle, aspect, camera.near_plane, camera.far_plane);
    const double height = std::abs(camera.half_extent.y);
    const double width = height * aspect;
    return glm::ortho(-width, width, -height, height, camera.near_plane, camera.far_plane);
}

/// The node's place and directions, without its scale.
glm::dmat4 view_of(const glm::dmat4& world) {
    const glm::dvec3 position(world[3]);
    const glm::dvec3 ahead = -glm::dvec3(world[2]);
    const glm::dvec3 up(world[1]);
    if (glm::length(glm::cross(ahead, up)) == 0) return glm::translate(glm::dmat4(1), -position);
    return glm::lookAt(position, position + glm::normalize(ahead), glm::normalize(up));
}

}  // namespace

std::optional<SceneView> view_of_camera(const Scene& scene, std::size_t camera, int width, int height) {
    for (const std::size_t index : scene.order) {
        const Node& node = scene.nodes[index];
        if (node.camera != camera) continue;
        const double aspect = static_cast<double>(width) / height;
        return SceneView{view_of(node.world), projection_of(scene.cameras[camera], aspect), width, height,
                         background_of(scene)};
    }
    return std::nullopt;
}

std::optional<std::size_t> first_camera(const Scene& scene) {
    for (const std::size_t index : scene.order)
        if (const auto& camera = scene.nodes[index].camera) return camera;
    return std::nullopt;
}

SceneView view_of_all(const std::vector<Draw>& draws, const glm::dvec3& direction, int width, int height) {
    Box bounds;
    for (const Draw& draw : draws)
        if (draw.bounds) bounds.add(*draw.bounds);
    if (bounds.is_empty()) bounds = {glm::dvec3(-1), glm::dvec3(1)};
    const glm::dvec3 center = (bounds.low + bounds.high) / 2.0;
    const double radius = std::max(glm::length(bounds.high - bounds.low) / 2, 1e-6);
    const double aspect = static_cast<double>(width) / height;
    const double half_angle = std::atan(std::tan(usual_angle / 2) * std::min(aspect, 1.0));
    const double distance = radius / std::sin(half_angle);
    const glm::dvec3 toward = glm::normalize(direction);
    const glm::dvec3 up = std::abs(toward.y) > 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    return {glm::lookAt(center + distance * toward, center, up),
            perspective(usual_angle, aspect, std::max(distance - radius, 1e-3 * distance) * 0.99,
                        (distance + radius) * 1.01),
            width, height};
}

std::array<float, 4> background_of(const Scene& scene) {
    const auto& fog = scene.overrides.fog;
    const bool is_clear = !fog || fog->kind == "none";
    const glm::dvec3 usual = is_clear ? glm::dvec3(0.05, 0.06, 0.08) : fog->color;
    const glm::vec3 color(scene.background.value_or(usual));
    return {color.r, color.g, color.b, 1};
}

ViewedObject viewed_by(const SceneView& view) {
    ViewedObject viewed;
    viewed.view = view.view;
    viewed.projection = view.projection;
    viewed.viewport = {view.width, view.height};
    return viewed;
}

}  // namespace gobo::scene
