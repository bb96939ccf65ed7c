// Triangle meshes: what is drawn.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/file_system.hpp"

namespace gobo {

/// An indexed triangle mesh in object space. Front faces run counter-clockwise. Normals have unit length.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;          ///< one per position
    std::vector<glm::vec2> texcoords;        ///< one per position
    std::vector<std::uint32_t> indices;      ///< three per triangle
    std::vector<glm::vec4> colors = {};      ///< RGBA, one per position, or none: white
    std::vector<glm::vec2> texcoords1 = {};  ///< the second set: one per position, or none
    std::vector<glm::vec4> tangents = {};    ///< one per position, or none; the bitangent's sign in w
};

/// A sphere of radius 1 about the origin, its poles on the y axis. At least 3 slices and 2 stacks.
[[nodiscard]] Mesh make_sphere(int slices, int stacks);
/// A torus about the y axis. `radius` is that of the circle of centres, `tube` that of the tube.
[[nodiscard]] Mesh make_torus(double radius, double tube, int slices, int sides);
/// A square in the plane y = 0 about the origin, its normal +y, of `side` length and cells * cells quads.
[[nodiscard]] Mesh make_plane(double side, int cells);

/// Reads a Wavefront OBJ: positions, faces (cut into triangles), and normals and texture coordinates where
/// every corner has them; otherwise normals are computed with a crease angle of 60 degrees.
[[nodiscard]] Result<Mesh> read_obj(const FileSystem& files, const std::string& path);

/// A box along the axes; the one around nothing is inside out.
struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point);
    [[nodiscard]] bool is_empty() const { return low.x > high.x; }
};
[[nodiscard]] Bounds bounds_of(const Mesh& mesh);

/// Values of an attribute, vertex by vertex: floats, or where it is an integer `integers`.
struct AttributeValues {
    int components = 1;
    std::vector<float> floats;
    std::vector<std::int32_t> integers;
};

/// What a mesh has for an attribute by the name of the source; nothing where it has none of that name, or no
/// colours. Besides position, normal, texcoord and color there are three for show, made from where a vertex
/// lies on its mesh:
/// tint: a colour, warm at the bottom of the mesh, over green to blue at its top, paler round the y axis on
/// one side; opaque. A flat mesh is white. material_number: the mesh is cut into seven sectors round the y
/// axis, 0 to 6. A flat mesh has 13. tile: texture coordinates by which a texture is laid six times across
/// the mesh, along x and y. A flat mesh shows the texture's corner all over.
[[nodiscard]] std::optional<AttributeValues> attribute_values(const Mesh& mesh, std::string_view source);
[[nodiscard]] const std::vector<std::string>& attribute_sources();

}  // namespace gobo
