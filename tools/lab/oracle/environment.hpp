// Light that has no one direction: of a sky and a ground, or of a whole environment, by harmonics or by cube
// maps.
#pragma once

#include "lab/oracle/model.hpp"
#include "lab/oracle/scene.hpp"

namespace gobo::oracle {

/// Ambient light at a surface, with what its accuracy hangs on.
struct AmbientLight {
    glm::dvec3 value{0};    ///< radiance
    glm::dvec3 largest{0};  ///< the sum of its absolute terms
    glm::dvec3 slope{0};    ///< at most so much per unit of error of the normal
};

/// The part of the sky that a surface at this angle (radians) from straight up sees: 1 - sin / 2 up to a
/// right angle and sin / 2 beyond it, exactly; (1 + cos) / 2 approximately. What is more or less than half
/// counts by the length of a normal that is interpolated as it is.
[[nodiscard]] double sky_weight(Hemisphere kind, double angle, double length = 1);

/// mix(G, S, weight of the sky). A zero normal sees half of each.
[[nodiscard]] AmbientLight hemisphere_light(Hemisphere kind, const HemisphereLight& light,
                                            const glm::dvec3& normal);

/// The irradiance of the nine coefficients on a surface facing the unit vector n of the probe's axes, as far
/// as the order goes; negative where a small bright light rings (Ramamoorthi and Hanrahan 2001, equation 13).
[[nodiscard]] glm::dvec3 irradiance(Harmonics order, const std::array<glm::dvec3, 9>& coefficients,
                                    const glm::dvec3& n);

/// max(scale irradiance, 0).
[[nodiscard]] AmbientLight harmonics_light(Harmonics order, const HarmonicsLight& light,
                                           const glm::dvec3& normal);

/// Light looked up, with what its accuracy hangs on.
struct LookedUp {
    glm::dvec3 value{0};  ///< radiance
    glm::dvec3 slope{0};  ///< at most so much per unit of error of the direction
};

/// mix(color, map(normal), weight); the color alone where the normal is zero.
[[nodiscard]] LookedUp ambient_from_image(const ImageLight& light, const glm::dvec3& normal);

/// weight map(r) with r = 2 (n.v) n - v; nothing where either vector is zero.
[[nodiscard]] LookedUp reflection_from_image(const ImageLight& light, const glm::dvec3& normal,
                                             const glm::dvec3& to_viewer);

}  // namespace gobo::oracle
