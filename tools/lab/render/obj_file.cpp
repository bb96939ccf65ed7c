#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include "core/text.hpp"
#include "lab/render/mesh.hpp"

namespace gobo {
namespace {

tl::unexpected<Diagnostics> unreadable(const std::string& path, std::string_view why) {
    Diagnostic diagnostic;
    diagnostic.place.file = path;
    diagnostic.message = fmt::format("this is no readable OBJ file: {}", why);
    return fail(std::move(diagnostic));
}

glm::vec3 triple_at(const std::vector<float>& values, int index) {
    const std::size_t first = 3 * static_cast<std::size_t>(index);
    return {values[first], values[first + 1], values[first + 2]};
}

std::vector<tinyobj::index_t> corners_of(const tinyobj::ObjReader& reader) {
    std::vector<tinyobj::index_t> corners;
    for (const tinyobj::shape_t& shape : reader.GetShapes())
        corners.insert(corners.end(), shape.mesh.indices.begin(), shape.mesh.indices.end());
    return corners;
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
        mesh.positions.push_back(triple_at(attributes.vertices, corner.vertex_index));
        mesh.normals.push_back(triple_at(attributes.normals, corner.normal_index));
        const auto texcoord = 2 * static_cast<std::size_t>(std::max(corner.texcoord_index, 0));
        const bool has_texcoord = corner.texcoord_index >= 0;
        mesh.texcoords.emplace_back(
            has_texcoord ? attributes.texcoords[texcoord] : mesh.positions.back().x,
            has_texcoord ? attributes.texcoords[texcoord + 1] : mesh.positions.back().y);
    }
    return mesh;
}

Mesh with_computed_normals(const tinyobj::attrib_t& attributes,
                           const std::vector<tinyobj::index_t>& corners) {
    std::vector<glm::vec3> positions;
    for (int i = 0; i < static_cast<int>(attributes.vertices.size() / 3); ++i)
        positions.push_back(triple_at(attributes.vertices, i));
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

}  // namespace

Result<Mesh> read_obj(const FileSystem& files, const std::string& path) {
    const auto text = files.read(path);
    if (!text) return tl::unexpected(text.error());
    tinyobj::ObjReaderConfig configuration;
    configuration.triangulate = true;
    tinyobj::ObjReader reader;
    if (!reader.ParseFromString(*text, "", configuration)) return unreadable(path, trim(reader.Error()));
    const tinyobj::attrib_t& attributes = reader.GetAttrib();
    const std::vector<tinyobj::index_t> corners = corners_of(reader);
    if (corners.empty()) return unreadable(path, "it has no faces");
    if (!in_range(attributes, corners)) return unreadable(path, "a face names a vertex that does not exist");
    for (const float value : attributes.vertices)
        if (!std::isfinite(value)) return unreadable(path, "a position is not finite");
    for (const tinyobj::index_t& corner : corners)
        if (corner.normal_index < 0) return with_computed_normals(attributes, corners);
    return with_own_normals(attributes, corners);
}

}  // namespace gobo
