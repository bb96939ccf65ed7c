#include <glm/geometric.hpp>

#include "scene/read_parts.hpp"

namespace gobo::scene {
namespace {

/// The corners of a strip's or a fan's triangles, wound as glTF says (specification, 3.7.2.1). What does not
/// fill a triangle is left out.
std::vector<std::uint32_t> listed(const std::vector<std::uint32_t>& corners, int mode) {
    std::vector<std::uint32_t> triangles;
    if (mode == 4) {
        triangles.assign(corners.begin(), corners.end() - static_cast<std::ptrdiff_t>(corners.size() % 3));
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool is_odd = i % 2 == 1;
        const std::size_t first = mode == 6 ? 0 : i;
        const std::size_t second = mode == 6 ? i + 1 : (is_odd ? i + 2 : i + 1);
        const std::size_t third = mode == 6 ? i + 2 : (is_odd ? i + 1 : i + 2);
        triangles.insert(triangles.end(), {corners[first], corners[second], corners[third]});
    }
    return triangles;
}

template <class T>
void spread(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    if (values.empty()) return;
    std::vector<T> result;
    result.reserve(indices.size());
    for (const std::uint32_t index : indices) result.push_back(values[index]);
    values = std::move(result);
}

/// The unit normal of a triangle; zero where it has no area.
glm::vec3 face_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    return length > 0 ? glm::vec3(normal / length) : glm::vec3(0);
}

/// Gives every triangle vertices of its own, with its normal.
void spread_with_flat_normals(Primitive& primitive) {
    spread(primitive.positions, primitive.indices);
    spread(primitive.texcoords, primitive.indices);
    spread(primitive.colors, primitive.indices);
    spread(primitive.influences, primitive.indices);
    for (auto& target : primitive.target_positions) spread(target, primitive.indices);
    for (std::size_t i = 0; i < primitive.indices.size(); ++i)
        primitive.indices[i] = static_cast<std::uint32_t>(i);
    primitive.normals = flat_normals(primitive.positions);
    primitive.has_flat_normals = true;
}

}  // namespace

std::vector<glm::vec3> flat_normals(const std::vector<glm::vec3>& positions) {
    std::vector<glm::vec3> normals;
    normals.reserve(positions.size());
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
        normals.insert(normals.end(), 3, face_normal(positions[i], positions[i + 1], positions[i + 2]));
    return normals;
}

void finish_triangles(Primitive& primitive, int mode) {
    primitive.indices = listed(primitive.indices, mode);
    if (primitive.normals.empty() && !primitive.indices.empty()) spread_with_flat_normals(primitive);
}

}  // namespace gobo::scene
