#include "lab/verify/test_meshes.hpp"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gobo::verify {
namespace {

/// The lower half of a sphere: seen from outside and, over its rim, from inside.
Mesh make_bowl() {
    Mesh bowl = make_sphere(12, 8);
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < bowl.indices.size(); i += 3) {
        const auto is_low = [&](std::size_t corner) { return bowl.positions[bowl.indices[corner]].y < 0.1F; };
        if (is_low(i) && is_low(i + 1) && is_low(i + 2))
            kept.insert(kept.end(), {bowl.indices[i], bowl.indices[i + 1], bowl.indices[i + 2]});
    }
    bowl.indices = std::move(kept);
    return bowl;
}

/// Moved to the origin and scaled so that its box reaches to 1.
Mesh fitted(Mesh mesh) {
    glm::vec3 low(mesh.positions.front());
    glm::vec3 high = low;
    for (const glm::vec3& position : mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const glm::vec3 half = (high - low) * 0.5F;
    const float scale = 1 / std::max({half.x, half.y, half.z});
    for (glm::vec3& position : mesh.positions) position = (position - (low + high) * 0.5F) * scale;
    return mesh;
}

}  // namespace

std::vector<Mesh> test_meshes(Mesh teapot) {
    return {make_sphere(12, 8), make_torus(0.7, 0.3, 12, 8), make_plane(2, 2), make_bowl(),
            fitted(std::move(teapot))};
}

}  // namespace gobo::verify
