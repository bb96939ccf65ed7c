#include <algorithm>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "lab/render/render_selection.hpp"

namespace gobo {
namespace {

constexpr double ground = -0.75;
constexpr double height = 1.5;
constexpr double width = 3;

/// Scales the mesh into the box and puts it on the ground.
glm::dmat4 placed(const Mesh& mesh) {
    if (mesh.positions.empty()) return glm::dmat4(1);
    glm::dvec3 low(mesh.positions.front());
    glm::dvec3 high(low);
    for (const glm::vec3& position : mesh.positions) {
        low = glm::min(low, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    const glm::dvec3 room = glm::dvec3(width, height, width) / glm::max(high - low, glm::dvec3(1e-9));
    const double scale = std::min({room.x, room.y, room.z});
    const glm::dvec3 foot((low.x + high.x) / 2, low.y, (low.z + high.z) / 2);
    return glm::translate(glm::dmat4(1), glm::dvec3(0, ground, 0)) *
           glm::scale(glm::dmat4(1), glm::dvec3(scale)) * glm::translate(glm::dmat4(1), -foot);
}

}  // namespace

std::vector<Object> demo_objects(Mesh mesh) {
    const glm::dmat4 model = placed(mesh);
    // Fine enough for light computed at the vertices to show its cones.
    return {{std::move(mesh), model, {}, false, true},
            {make_plane(12, 96), glm::translate(glm::dmat4(1), glm::dvec3(0, ground, 0)), {}, false, false}};
}

Camera demo_camera() {
    Camera camera;
    camera.position = {0, 1.5, 5};
    camera.target = {0, -0.05, 0};
    camera.field_of_view = 0.6;
    camera.far_plane = 50;
    return camera;
}

}  // namespace gobo
