#include "lab/render/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <tiny_obj_loader.h>

#include "core/text.hpp"

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

tl::unexpected<Diagnostics> unreadable(const std::string& path, std::string_view why) {
    return fail(Place{path}, {}, fmt::format("this is not a readable OBJ file: {}", why));
}

/// One vertex for each distinct triple of indices, as the file's own normals tell.
Mesh with_own_normals(const tinyobj::attrib_t& attributes, const std::vector<tinyobj::index_t>& corners) {
    Mesh mesh;
    std::map<std::tuple<int, int, int>, std::uint32_t> vertices;
    for (const tinyobj::index_t& corner : corners) {
        const auto next = static_cast<std::uint32_t>(mesh.positions.size());
        const auto [vertex, added] = vertices.try_emplace(
            std::tuple(corner.vertex_index, corner.normal_index, corner.texcoord_index), next);
        mesh.indices.push_back(vertex->second);
        if (!added) continue;
        mesh.positions.push_back(
            glm::make_vec3(&attributes.vertices[3 * static_cast<std::size_t>(corner.vertex_index)]));
        mesh.normals.push_back(
            glm::make_vec3(&attributes.normals[3 * static_cast<std::size_t>(corner.normal_index)]));
        const auto texcoord = 2 * static_cast<std::size_t>(std::max(corner.texcoord_index, 0));
        const bool has_texcoord = corner.texcoord_index >= 0;
        mesh.texcoords.emplace_back(
            has_texcoord ? attributes.texcoords[texcoord] : mesh.positions.back().x,
            has_texcoord ? attributes.texcoords[texcoord + 1] : mesh.positions.back().y);
    }
    return mesh;
}

/// A mesh with smooth normals: each corner's is the area-weighted mean of the faces that meet there and lie
/// within `crease_angle` (radians) of its own. Faces meet where positions are equal, whatever their index.
/// Triangles without area are left out. Texture coordinates are x and y.
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

Mesh with_computed_normals(const tinyobj::attrib_t& attributes,
                           const std::vector<tinyobj::index_t>& corners) {
    std::vector<glm::vec3> positions;
    for (std::size_t i = 0; i < attributes.vertices.size(); i += 3)
        positions.push_back(glm::make_vec3(&attributes.vertices[i]));
    std::vector<std::uint32_t> indices;
    for (const tinyobj::index_t& corner : corners)
        indices.push_back(static_cast<std::uint32_t>(corner.vertex_index));
    return with_smooth_normals(positions, indices, std::numbers::pi / 3);
}

/// Whether every corner names a vertex, and its normal where it has one, that the file holds.
bool in_range(const tinyobj::attrib_t& attributes, const std::vector<tinyobj::index_t>& corners) {
    const auto holds = [](int index, std::size_t values, std::size_t width) {
        return index < 0 || (static_cast<std::size_t>(index) + 1) * width <= values;
    };
    for (const tinyobj::index_t& corner : corners)
        if (corner.vertex_index < 0 || !holds(corner.vertex_index, attributes.vertices.size(), 3) ||
            !holds(corner.normal_index, attributes.normals.size(), 3) ||
            !holds(corner.texcoord_index, attributes.texcoords.size(), 2))
            return false;
    return true;
}

template <class Vector>
AttributeValues flattened(const std::vector<Vector>& vectors) {
    AttributeValues values{Vector::length(), {}, {}};
    values.floats.reserve(vectors.size() * static_cast<std::size_t>(values.components));
    for (const Vector& vector : vectors)
        values.floats.insert(values.floats.end(), &vector[0], &vector[0] + Vector::length());
    return values;
}

/// Where vertices lie on their mesh.
class Places {
  public:
    explicit Places(const Mesh& mesh) {
        const Bounds bounds = bounds_of(mesh);
        if (bounds.is_empty()) return;
        low_ = bounds.low;
        high_ = bounds.high;
    }

    [[nodiscard]] bool is_flat() const {
        const glm::vec3 size = high_ - low_;
        return size.y <= 0.01F * std::max(size.x, size.z);
    }
    /// 0 at the bottom, 1 at the top.
    [[nodiscard]] float height(const glm::vec3& position) const {
        return (position.y - low_.y) / (high_.y - low_.y);
    }
    /// The turn about the y axis, 0 to 1, seen from the middle.
    [[nodiscard]] float turn(const glm::vec3& position) const {
        const glm::vec3 middle = 0.5F * (low_ + high_);
        const float angle = std::atan2(position.x - middle.x, position.z - middle.z);
        return 0.5F + angle / (2 * std::numbers::pi_v<float>);
    }
    /// Texture coordinates that go so many times from 0 to 1 along x.
    [[nodiscard]] glm::vec2 tiles(const glm::vec3& position, float count) const {
        return count / (high_.x - low_.x) * (glm::vec2(position) - glm::vec2(low_));
    }

  private:
    glm::vec3 low_{0};
    glm::vec3 high_{0};
};

glm::vec4 tint(const glm::vec3& position, const Places& places) {
    const glm::vec3 bottom(1, 0.35F, 0.12F);
    const glm::vec3 middle(0.4F, 1, 0.35F);
    const glm::vec3 top(0.2F, 0.45F, 1);
    const float height = 2 * places.height(position);
    const float turn = 2 * std::numbers::pi_v<float> * places.turn(position);
    const glm::vec3 hue = height < 1 ? glm::mix(bottom, middle, height) : glm::mix(middle, top, height - 1);
    return glm::vec4(glm::mix(hue, glm::vec3(1), 0.15F + 0.15F * std::cos(turn)), 1);
}

AttributeValues material_numbers(const Mesh& mesh, const Places& places) {
    constexpr int kSectors = 7;
    constexpr std::int32_t kOfFlat = 13;
    AttributeValues values;
    for (const glm::vec3& position : mesh.positions)
        values.integers.push_back(
            places.is_flat()
                ? kOfFlat
                : std::clamp(static_cast<int>(places.turn(position) * kSectors), 0, kSectors - 1));
    return values;
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

Result<Mesh> read_obj(const FileSystem& files, const std::string& path) {
    GOBO_TRY(const std::string text, files.read(path));
    tinyobj::ObjReaderConfig configuration;
    configuration.triangulate = true;
    tinyobj::ObjReader reader;
    if (!reader.ParseFromString(text, "", configuration)) return unreadable(path, trim(reader.Error()));
    const tinyobj::attrib_t& attributes = reader.GetAttrib();
    std::vector<tinyobj::index_t> corners;
    for (const tinyobj::shape_t& shape : reader.GetShapes())
        corners.insert(corners.end(), shape.mesh.indices.begin(), shape.mesh.indices.end());
    if (corners.empty()) return unreadable(path, "it has no faces");
    if (!in_range(attributes, corners)) return unreadable(path, "a face names a vertex that does not exist");
    for (const float value : attributes.vertices)
        if (!std::isfinite(value)) return unreadable(path, "a position is not finite");
    for (const tinyobj::index_t& corner : corners)
        if (corner.normal_index < 0) return with_computed_normals(attributes, corners);
    return with_own_normals(attributes, corners);
}

void Bounds::add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
}

Bounds bounds_of(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) bounds.add(glm::dvec3(position));
    return bounds;
}

const std::vector<std::string>& attribute_sources() {
    static const std::vector<std::string> sources = {
        "position", "normal", "texcoord", "color", "tint", "material_number", "tile", "texcoord1", "tangent"};
    return sources;
}

std::optional<AttributeValues> attribute_values(const Mesh& mesh, std::string_view source) {
    if (source == "position") return flattened(mesh.positions);
    if (source == "normal") return flattened(mesh.normals);
    if (source == "texcoord") return flattened(mesh.texcoords);
    if (source == "color" && !mesh.colors.empty()) return flattened(mesh.colors);
    if (source == "texcoord1" && !mesh.texcoords1.empty()) return flattened(mesh.texcoords1);
    if (source == "tangent" && !mesh.tangents.empty()) return flattened(mesh.tangents);
    const Places places(mesh);
    if (source == "material_number") return material_numbers(mesh, places);
    const auto each = [&](const auto& value, auto of_flat) {
        std::vector<decltype(of_flat)> values;
        for (const glm::vec3& position : mesh.positions)
            values.push_back(places.is_flat() ? of_flat : value(position));
        return flattened(values);
    };
    if (source == "tint")
        return each([&](const glm::vec3& position) { return tint(position, places); }, glm::vec4(1));
    if (source == "tile")
        return each([&](const glm::vec3& position) { return places.tiles(position, 6); }, glm::vec2(0));
    return std::nullopt;
}

}  // namespace gobo
