#include "orbit.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace viewer {
namespace {

constexpr double usual_angle = 0.7;    ///< of a view of everything, radians from its lower to its upper edge
constexpr double usual_height = 0.35;  ///< of its camera above the horizon, radians

Orbit around_everything(const Stage& stage, int width, int height) {
    const double distance = stage.radius / std::sin(usual_angle / 2);
    const glm::dvec3 toward(0, std::sin(usual_height), std::cos(usual_height));
    gobo::scene::SceneView start;
    start.view = glm::lookAt(stage.center + distance * toward, stage.center, glm::dvec3(0, 1, 0));
    start.projection = glm::perspective(usual_angle, static_cast<double>(width) / height,
                                        (distance - stage.radius) * 0.9, (distance + stage.radius) * 1.1);
    start.background = gobo::scene::background_of(stage.scene);
    return {start, stage.center};
}

}  // namespace

glm::dmat4 Orbit::view() const {
    const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1), center), -angle, glm::dvec3(0, 1, 0));
    return start.view * glm::translate(turned, -center);
}

Orbit orbit_of(const Stage& stage, int width, int height) {
    const auto camera = gobo::scene::first_camera(stage.scene);
    const auto start =
        camera ? gobo::scene::view_of_camera(stage.scene, *camera, width, height) : std::nullopt;
    if (!start) return around_everything(stage, width, height);
    const glm::dmat4 world = glm::inverse(start->view);
    const glm::dvec3 position(world[3]);
    const glm::dvec3 ahead = -glm::dvec3(world[2]);
    return {*start, position + std::max(glm::dot(stage.center - position, ahead), 0.0) * ahead};
}

}  // namespace viewer
