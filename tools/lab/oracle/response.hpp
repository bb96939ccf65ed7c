// What a surface gives back of the light that arrives.
#pragma once

#include "lab/oracle/lights.hpp"
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

/// 1 - cos of an angle.
[[nodiscard]] double one_minus_cosine_of(double angle);

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

}  // namespace gobo::oracle
