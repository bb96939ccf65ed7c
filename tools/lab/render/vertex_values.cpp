#include "lab/render/vertex_values.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace gobo {
namespace {

/// The box around a mesh.
struct Extent {
    glm::vec3 low{0};
    glm::vec3 high{0};
};

Extent extent_of(const Mesh& mesh) {
    Extent extent;
    if (mesh.positions.empty()) return extent;
    extent.low = extent.high = mesh.positions.front();
    for (const glm::vec3& position : mesh.positions) {
        extent.low = glm::min(extent.low, position);
        extent.high = glm::max(extent.high, position);
    }
    return extent;
}

bool is_flat(const Extent& extent) {
    const glm::vec3 size = extent.high - extent.low;
    return size.y <= 0.01F * std::max(size.x, size.z);
}

/// How far up a vertex lies, 0 to 1.
float height_of(const glm::vec3& position, const Extent& extent) {
    return (position.y - extent.low.y) / (extent.high.y - extent.low.y);
}

/// The turn about the y axis, 0 to 1, of a vertex seen from the middle.
float turn_of(const glm::vec3& position, const Extent& extent) {
    const glm::vec3 middle = 0.5F * (extent.low + extent.high);
    const float angle = std::atan2(position.x - middle.x, position.z - middle.z);
    return 0.5F + angle / (2 * std::numbers::pi_v<float>);
}

}  // namespace

std::vector<glm::vec4> vertex_tints(const Mesh& mesh) {
    const glm::vec3 bottom(1, 0.35F, 0.12F);
    const glm::vec3 middle(0.4F, 1, 0.35F);
    const glm::vec3 top(0.2F, 0.45F, 1);
    std::vector<glm::vec4> tints(mesh.positions.size(), glm::vec4(1));
    const Extent extent = extent_of(mesh);
    if (is_flat(extent)) return tints;
    for (std::size_t i = 0; i < tints.size(); ++i) {
        const float height = 2 * height_of(mesh.positions[i], extent);
        const float turn = 2 * std::numbers::pi_v<float> * turn_of(mesh.positions[i], extent);
        const glm::vec3 hue =
            height < 1 ? glm::mix(bottom, middle, height) : glm::mix(middle, top, height - 1);
        tints[i] = glm::vec4(glm::mix(hue, glm::vec3(1), 0.15F + 0.15F * std::cos(turn)), 1);
    }
    return tints;
}

std::vector<std::int32_t> material_numbers(const Mesh& mesh) {
    constexpr int kSectors = 7;
    constexpr std::int32_t kOfFlat = 13;
    std::vector<std::int32_t> numbers(mesh.positions.size(), kOfFlat);
    const Extent extent = extent_of(mesh);
    if (is_flat(extent)) return numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] =
            std::clamp(static_cast<int>(turn_of(mesh.positions[i], extent) * kSectors), 0, kSectors - 1);
    return numbers;
}

std::vector<glm::vec2> tiled_texcoords(const Mesh& mesh) {
    constexpr float kTiles = 6;
    std::vector<glm::vec2> coordinates(mesh.positions.size(), glm::vec2(0));
    const Extent extent = extent_of(mesh);
    if (is_flat(extent)) return coordinates;
    const float scale = kTiles / (extent.high.x - extent.low.x);
    for (std::size_t i = 0; i < coordinates.size(); ++i)
        coordinates[i] = scale * (glm::vec2(mesh.positions[i]) - glm::vec2(extent.low));
    return coordinates;
}

}  // namespace gobo
