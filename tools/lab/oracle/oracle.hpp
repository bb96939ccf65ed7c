// The lighting models of the family `lit` in double precision, written from their equations and sharing
// nothing with shader_lib/: what a permutation's outputs ought to be.
//
// Sources: OpenGL Programming Guide, 9th ed., ch. 7; OpenGL 4 Shading Language Cookbook, ch. 2 and 3; Khronos
// glTF 2.0 KHR_lights_punctual; each function names the equation it is.
#pragma once

#include <optional>
#include <vector>

#include "lab/oracle/environment.hpp"
#include "lab/oracle/response.hpp"

namespace gobo::oracle {

/// The radiance that leaves a surface towards the viewer, before fog, and how it comes about.
struct Radiance {
    glm::dvec3 value{0};
    /// The sum of all terms with every angle's factor taken as 1, and at least their absolute values: what an
    /// error is measured by. Zero only where no light reaches the point at all.
    glm::dvec3 largest{0};
    std::vector<LightTerm> terms;  ///< one for each light
    Material material;             ///< that of the side that is seen, tinted by the vertices' colour
    AmbientLight ambient;          ///< without the lights' own
    LookedUp reflected;            ///< without the highlight's reflectivity
};

/// The material of the point: the one there is, or row i of the table, with two materials row 2 i in front
/// and 2 i + 1 at the back; where the index is beyond the table, of the nearest row or pair.
[[nodiscard]] const Material& material_of(const Model& model, const Scene& scene, const SurfacePoint& point);

/// The unit vector to the viewer, at the origin or infinitely far along +z; zero at the viewer itself.
[[nodiscard]] glm::dvec3 to_viewer(const Model& model, const glm::dvec3& position);

/// emission + K_a (A + sum A_l attenuation) + K_d sum f_d L + strength K_s sum f_s L, over exactly the lights
/// of the scene, with K_a and K_d tinted and the normal flipped on the back where the model says so; unlit,
/// K_d alone. Toon tones by thresholds add up to no more than the brightest tone of the brightest light that
/// gives one.
[[nodiscard]] Radiance lit_radiance(const Model& model, const Scene& scene, const SurfacePoint& point,
                                    Decisions& decisions);

/// How much fog lies before a point: |p| or |p.z|.
[[nodiscard]] double fog_distance(FogDistance kind, const glm::dvec3& position);

/// The part of the surface's radiance that gets through, 0 to 1. Where start = end linear fog is a step:
/// clear before that distance, hidden from it on.
[[nodiscard]] double fog_factor(Fog kind, const FogParameters& fog, double distance, Decisions& decisions);

/// What is seen of that radiance through the fog: f L + (1 - f) C.
struct Seen {
    glm::dvec3 value{0};
    glm::dvec3 largest{0};
    double distance = 0;    ///< of fog
    double fog_factor = 1;  ///< f
};
[[nodiscard]] Seen seen_through_fog(const Model& model, const Scene& scene, const glm::dvec3& position,
                                    const glm::dvec3& radiance, const glm::dvec3& largest,
                                    Decisions& decisions);

/// The radiance, at most the largest number of the target: 65504 of IEEE 754 binary16, 1 of a display.
[[nodiscard]] glm::dvec3 within_range(OutputRange range, const glm::dvec3& radiance);

/// Whether the point is cut out: the alpha of the opacity map times that of the vertices is below the
/// threshold.
[[nodiscard]] bool is_cut_out(const Model& model, const Scene& scene, const SurfacePoint& point,
                              Decisions& decisions);

/// How opaque the point is.
[[nodiscard]] double alpha_of(const Model& model, const SurfacePoint& point);

/// The depth that the fragment writes, of its own window depth in [0, 1]; nothing where it writes none. The
/// offset counts only towards the side that the key promises, and the result stays within [0, 1].
[[nodiscard]] std::optional<double> written_depth(const Model& model, const Scene& scene, double depth);

}  // namespace gobo::oracle
