#include "lab/render/mesh.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <glm/geometric.hpp>

namespace gobo {
namespace {

using Position = std::tuple<float, float, float>;

/// A grid of columns x rows quads; `vertex(u, v)` adds the vertex at u, v in [0, 1].
template <class Vertex>
Mesh make_grid(int columns, int rows, const Vertex& vertex) {
    Mesh mesh;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column)
            vertex(mesh, static_cast<double>(column) / columns, static_cast<double>(row) / rows);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto corner = static_cast<std::uint32_t>(row * (columns + 1) + column);
            const std::uint32_t above = corner + static_cast<std::uint32_t>(columns) + 1;
            for (const std::uint32_t index : {corner, corner + 1, above + 1, corner, above + 1, above})
                mesh.indices.push_back(index);
        }
    }
    return mesh;
}

void add_vertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal, double u, double v) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(glm::normalize(normal));
    mesh.texcoords.emplace_back(u, v);
}

Position key_of(const glm::vec3& position) {
    return {position.x, position.y, position.z};
}

/// The face's normal; its length is twice the face's area.
glm::dvec3 area_normal(const std::vector<glm::vec3>& positions, const std::uint32_t* corner) {
    const glm::dvec3 origin(positions[corner[0]]);
    return glm::cross(glm::dvec3(positions[corner[1]]) - origin, glm::dvec3(positions[corner[2]]) - origin);
}

/// The mean of the faces around a corner that lie within the crease angle of the corner's own face.
glm::dvec3 corner_normal(const glm::dvec3& own, const std::vector<glm::dvec3>& around, double cosine) {
    const glm::dvec3 direction = glm::normalize(own);
    glm::dvec3 sum(0);
    for (const glm::dvec3& normal : around)
        if (glm::dot(glm::normalize(normal), direction) >= cosine) sum += normal;
    const double length = glm::length(sum);
    return length > 0 ? sum / length : direction;
}

}  // namespace

Mesh make_sphere(int slices, int stacks) {
    return make_grid(slices, stacks, [](Mesh& mesh, double u, double v) {
        const double around = 2 * std::numbers::pi * u;
        const double up = std::numbers::pi * (v - 0.5);
        const glm::dvec3 point(std::cos(up) * std::sin(around), std::sin(up),
                               std::cos(up) * std::cos(around));
        add_vertex(mesh, point, point, u, v);
    });
}

Mesh make_torus(double radius, double tube, int slices, int sides) {
    return make_grid(slices, sides, [=](Mesh& mesh, double u, double v) {
        const double around = 2 * std::numbers::pi * u;
        const double up = 2 * std::numbers::pi * v;
        const glm::dvec3 outward(std::sin(around), 0, std::cos(around));
        const glm::dvec3 normal = std::cos(up) * outward + glm::dvec3(0, std::sin(up), 0);
        add_vertex(mesh, radius * outward + tube * normal, normal, u, v);
    });
}

Mesh make_plane(double side, int cells) {
    return make_grid(cells, cells, [=](Mesh& mesh, double u, double v) {
        add_vertex(mesh, {side * (u - 0.5), 0, side * (0.5 - v)}, {0, 1, 0}, u, v);
    });
}

Mesh with_smooth_normals(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices,
                         double crease_angle) {
    std::map<Position, std::vector<glm::dvec3>> faces_at;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 normal = area_normal(positions, &indices[i]);
        if (glm::length(normal) == 0) continue;
        for (std::size_t corner = 0; corner < 3; ++corner)
            faces_at[key_of(positions[indices[i + corner]])].push_back(normal);
    }
    Mesh mesh;
    std::map<std::pair<Position, Position>, std::uint32_t> vertices;  // by position and normal
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 own = area_normal(positions, &indices[i]);
        if (glm::length(own) == 0) continue;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::vec3& position = positions[indices[i + corner]];
            const glm::vec3 normal(corner_normal(own, faces_at[key_of(position)], std::cos(crease_angle)));
            const auto next = static_cast<std::uint32_t>(mesh.positions.size());
            const auto [vertex, added] =
                vertices.try_emplace(std::pair(key_of(position), key_of(normal)), next);
            if (added) add_vertex(mesh, position, normal, position.x, position.y);
            mesh.indices.push_back(vertex->second);
        }
    }
    return mesh;
}

}  // namespace gobo
