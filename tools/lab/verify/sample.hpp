// Points at which the permutations of `lit` are tried: a surface point with everything that lights it, made
// to exercise the model that the key stands for.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "compose/composition.hpp"
#include "lab/oracle/model.hpp"
#include "lab/oracle/scene.hpp"
#include "lab/render/mesh.hpp"

namespace gobo::verify {

/// One invocation of a stage: every sample has lights, a material and matrices of its own.
struct Sample {
    oracle::Model model;  ///< that it was made for
    oracle::Scene scene;

    // What a vertex stage reads besides.
    glm::dvec3 object_position{0};
    glm::dvec3 object_normal{0};
    glm::dvec4 object_tangent{1, 0, 0, 1};
    glm::dmat4 model_view{1};
    glm::dmat4 projection{1};
    glm::dmat3 normal_matrix{1};

    // What a fragment stage reads besides.
    oracle::SurfacePoint surface;  ///< interpolated: the normal is shorter than 1
    glm::dvec3 lit_radiance{0};    ///< of shading per vertex
    double depth = 0;              ///< in the window, 0 to 1
    glm::dvec3 back_radiance{0};   ///< of the other side, of shading per vertex
    bool is_front_facing = true;   ///< as the triangle runs on the screen
    double handedness = 1;         ///< -1 where the model is mirrored
};

/// Ordinary inputs: coordinates to 1e3, local lights from 1e-2 to 1e3 away (in a vertex stage, where the eye
/// position is itself rounded, not nearer than a tenth of the coordinates), shininess and cone exponents 0
/// and 0.1 to 1e3, cones of 0.01 radians up to the half space and all directions. Lights stand around the
/// point, in front of it, behind it, and where its highlight is. The same seed gives the same samples.
[[nodiscard]] std::vector<Sample> make_samples(const oracle::Model& model, StageKind stage, int count,
                                               std::uint64_t seed);

/// A draw of the mesh, whose vertices lie within about 1 of its origin: matrices that bring it before the
/// viewer, and all that lights the surface around one of its vertices, for which the sample stands.
[[nodiscard]] Sample make_draw(const oracle::Model& model, const Mesh& mesh, std::uint64_t seed);

/// The draw's sample at a vertex: what the vertex stage reads there.
[[nodiscard]] Sample at_vertex(const Sample& draw, const Mesh& mesh, std::size_t vertex);

/// The sample with every number rounded to a float, as an application would hand it to a shader.
[[nodiscard]] Sample rounded_to_float(Sample sample);
[[nodiscard]] std::vector<Sample> rounded_to_float(std::vector<Sample> samples);

}  // namespace gobo::verify
