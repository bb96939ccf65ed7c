// The lighting models of the family `lit` in double precision, written from their equations and sharing
// nothing with shader_lib/: what a permutation's outputs ought to be.
//
// Sources: OpenGL Programming Guide, 9th ed., ch. 7; OpenGL 4 Shading Language Cookbook, ch. 2 and 3; Khronos
// glTF 2.0 KHR_lights_punctual; each function names the equation it is.
#pragma once

#include <optional>
#include <vector>

#include "lab/oracle/environment.hpp"
#include "lab/oracle/lights.hpp"
#include "lab/oracle/microfacets.hpp"
#include "lab/oracle/model.hpp"

namespace gobo::oracle {

/// The diffuse factor of a light at a cosine to the normal that is not negative: the cosine itself; for toon
/// shading floor(N c) / N, at most (N - 1) / N, or ceil(N c) / N, at most 1; or the tone of the first
/// threshold that the cosine exceeds, else 0.
[[nodiscard]] double diffuse_factor(const Model& model, const Scene& scene, double cosine,
                                    Decisions& decisions);

/// The angle whose cosine's power is the highlight: between normal and half vector (Blinn), or between
/// mirrored light and viewer (Phong). `normal` and `to_light` are unit; a zero `to_viewer` is a viewer in no
/// direction.
[[nodiscard]] double highlight_angle(Specular specular, const glm::dvec3& normal, const glm::dvec3& to_light,
                                     const glm::dvec3& to_viewer);

/// The lobe of a highlight at 1 - cos of an angle, from 0 to 2:
/// - exact: max(cos, 0)^m, with 0^0 = 1;
/// - near_exact: exp(2 m (z + z^3 / 3)) with z = (cos - 1) / (cos + 1), the beginning of the series of
///   log(cos) (Abramowitz and Stegun 4.1.27); 0 from a right angle on, where m > 0;
/// - squaring: max(cos, 0)^n, n the whole number nearest to m, an even one where two are as near;
/// - gaussian, gaussian_fitted: exp(s (cos - 1)) with s = m, or s = m + 0.664 (Wang et al., 2009);
/// - lyon: max(1 - m (1 - cos) / 4, 0)^4 (Lyon, 1993);
/// - schlick: cos / (m - m cos + cos) (Schlick, Graphics Gems IV); 0 from a right angle on, where m > 0.
[[nodiscard]] double lobe(Power power, double one_minus_cosine, double shininess);

/// How the surface is seen: what every light's highlight hangs on.
struct View {
    glm::dvec3 normal{0};     ///< unit, unless it is interpolated as it is
    glm::dvec3 to_viewer{0};  ///< unit; zero: in no direction
    double shininess = 0;
    /// Per light, what hybrid shading interpolates; empty where it is found from light and viewer.
    std::vector<glm::dvec3> halfways;
    /// Per light, its cosine to the side that is seen; empty where it is found from normal and light.
    std::vector<double> cosines;
};

/// 1 - cos of the highlight's angle for light number `light`. Directions that are interpolated as they are
/// count by their length: the cosine is the dot product then.
[[nodiscard]] double highlight_one_minus_cosine(const Model& model, const View& view,
                                                const glm::dvec3& to_light, std::size_t light);

/// One light's part of the radiance, with what its accuracy hangs on.
struct LightTerm {
    IncidentLight incident;
    double cosine = 0;  ///< between normal and light
    bool is_lit = false;
    double diffuse = 0;                     ///< factor of what arrives
    double specular = 0;                    ///< as above
    double highlight_one_minus_cosine = 0;  ///< as above
    double half_length = 2;                 ///< |s + v|: near 0 the half vector is ill-defined
    glm::dvec3 ambient{0};                  ///< what the light adds to the ambient light
};

/// What light number `light`, arriving so, does at the surface.
[[nodiscard]] LightTerm respond(const Model& model, const Scene& scene, const View& view,
                                const IncidentLight& incident, std::size_t light, Decisions& decisions);

/// The radiance that leaves a surface towards the viewer, before fog, and how it comes about.
struct Radiance {
    glm::dvec3 value{0};
    /// The sum of all terms with every angle's factor taken as 1, and at least their absolute values: what an
    /// error is measured by. Zero only where no light reaches the point at all.
    glm::dvec3 largest{0};
    std::vector<LightTerm> terms;           ///< one for each light
    Material material;                      ///< that of the side that is seen, tinted by the vertices' colour
    AmbientLight ambient;                   ///< without the lights' own
    LookedUp reflected;                     ///< without the highlight's reflectivity
    std::optional<PhysicalPoint> physical;  ///< of `pbr`, which has no terms
    glm::dvec3 of_white{0};                 ///< of `pbr`: PhysicalRadiance::of_white
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
[[nodiscard]] double alpha_of(const Model& model, const Scene& scene, const SurfacePoint& point);

/// The depth that the fragment writes, of its own window depth in [0, 1]; nothing where it writes none. The
/// offset counts only towards the side that the key promises, and the result stays within [0, 1].
[[nodiscard]] std::optional<double> written_depth(const Model& model, const Scene& scene, double depth);

}  // namespace gobo::oracle
