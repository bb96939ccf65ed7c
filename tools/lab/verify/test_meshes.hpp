// The meshes on which whole pipelines are tried.
#pragma once

#include <vector>

#include "lab/render/mesh.hpp"

namespace gobo::verify {

/// A coarse sphere, torus and plane, an open bowl that shows both of its sides, and the given mesh, all
/// within about 1 of the origin: triangles of many pixels, where shading rates differ, and of one.
[[nodiscard]] std::vector<Mesh> test_meshes(Mesh teapot);

}  // namespace gobo::verify
