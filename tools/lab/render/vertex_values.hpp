// Values that vertices are given for show, made from where they lie on their mesh.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "lab/render/mesh.hpp"

namespace gobo {

/// A colour for each vertex: warm at the bottom of the mesh, over green to blue at its top, paler round the y
/// axis on one side; opaque. A flat mesh is white.
[[nodiscard]] std::vector<glm::vec4> vertex_tints(const Mesh& mesh);

/// An index for each vertex: the mesh is cut into seven sectors round the y axis, 0 to 6. A flat mesh has 13.
[[nodiscard]] std::vector<std::int32_t> material_numbers(const Mesh& mesh);

/// Texture coordinates by which a texture is laid six times across the mesh, along x and y. A flat mesh shows
/// the texture's corner all over.
[[nodiscard]] std::vector<glm::vec2> tiled_texcoords(const Mesh& mesh);

}  // namespace gobo
