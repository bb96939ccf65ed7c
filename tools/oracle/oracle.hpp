// The lighting models of the family `lit` in double precision, written from their equations and sharing
// nothing with shader_lib/: what a permutation's outputs ought to be.
//
// Sources: OpenGL Programming Guide, 9th ed., ch. 7; OpenGL 4 Shading Language Cookbook, ch. 2 and 3; Khronos
// glTF 2.0 KHR_lights_punctual; each function names the equation it is.
#pragma once

#include <optional>
#include <vector>

#include "oracle/fog.hpp"
#include "oracle/response.hpp"

namespace gobo::oracle {

/// The radiance that leaves a surface towards the viewer, before fog, and how it comes about.
struct Radiance {
    glm::dvec3 value{0};
    /// The sum of all terms with every angle's share taken as 1, and at least their absolute values: what an
    /// error is measured by. Zero only where no light reaches the point at all.
    glm::dvec3 largest{0};
    std::vector<LightTerm> terms;  ///< one for each light
};

/// emission + K_a A + K_d sum f_d L + strength K_s sum f_s L, over exactly the lights of the scene.
[[nodiscard]] Radiance lit_radiance(const Model& model, const Scene& scene, const SurfacePoint& point,
                                    Decisions& decisions);

/// What is seen of that radiance through the fog: f L + (1 - f) C.
struct Seen {
    glm::dvec3 value{0};
    glm::dvec3 largest{0};
    double distance = 0;   ///< of fog
    double clearness = 1;  ///< f
};
[[nodiscard]] Seen seen_through_fog(const Model& model, const Scene& scene, const glm::dvec3& position,
                                    const glm::dvec3& radiance, const glm::dvec3& largest,
                                    Decisions& decisions);

/// The depth that the fragment writes, of its own window depth in [0, 1]; nothing where it writes none. The
/// offset counts only towards the side that the key promises, and the result stays within [0, 1].
[[nodiscard]] std::optional<double> written_depth(const Model& model, const Scene& scene, double depth);

}  // namespace gobo::oracle
