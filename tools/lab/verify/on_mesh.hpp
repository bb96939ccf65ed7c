// A permutation's whole pipeline on a rasterised mesh, against the oracle.
#pragma once

#include <vector>

#include "lab/oracle/model.hpp"
#include "lab/raster/shade.hpp"
#include "lab/render/mesh.hpp"
#include "lab/verify/report.hpp"

namespace gobo::verify {

/// Draws the mesh 16 x 16: the vertex stage at the vertices, interpolation, the fragment stage at each pixel.
///
/// The oracle goes the same way: it judges the vertex stage's outputs, takes them by the names of what they
/// ought to be, interpolates them as they ought to be, and answers for the fragments that result. So what is
/// computed per vertex and what per fragment is its own affair, and a varying that is wrong, taken for
/// another or interpolated in a wrong way shows. Each stage is judged for the numbers that reach it, so that
/// errors do not add up over the stages and the bounds of single stages hold.
///
/// The reports are the vertex stage's and the fragment stage's. An error for a varying of which the oracle
/// does not say what it ought to be.
[[nodiscard]] Result<std::vector<StageReport>> check_on_mesh(const raster::Pipeline& pipeline,
                                                             const oracle::Model& model, const Mesh& mesh,
                                                             std::uint64_t seed);

/// A coarse sphere, torus and plane, an open bowl that shows both of its sides, and the given mesh, all
/// within about 1 of the origin: triangles of many pixels, where shading rates differ, and of one.
[[nodiscard]] std::vector<Mesh> test_meshes(Mesh teapot);

}  // namespace gobo::verify
