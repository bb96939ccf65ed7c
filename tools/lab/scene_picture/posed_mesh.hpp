// A primitive of a scene as it stands at rest: morphed by its weights, bent by its skin.
#pragma once

#include <glm/mat4x4.hpp>

#include "lab/render/mesh.hpp"
#include "scene/scene.hpp"

namespace gobo::scene {

/// A mesh with where it stands.
struct PosedMesh {
    gobo::Mesh mesh;
    glm::dmat4 model{1};  ///< to world space; the identity for a skinned mesh, whose joints place it
};

/// The primitive of the node's mesh, at rest. Its morph targets move positions and normals by the node's
/// weights, or else the mesh's; its skin then takes every vertex to world space (glTF 2.0 specification,
/// 3.7.3.1). A vertex without joints stays where it is. Instances become one mesh.
[[nodiscard]] PosedMesh posed_mesh(const Scene& scene, std::size_t node, const Primitive& primitive);

}  // namespace gobo::scene
