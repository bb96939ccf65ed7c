// Light that has no one direction: of a sky and a ground, or of a whole environment.
#pragma once

#include <array>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "lab/oracle/model.hpp"

namespace gobo::oracle {

/// A sky on one side, a ground on the other.
struct HemisphereLight {
    glm::dvec3 up{0, 1, 0};  ///< unit, eye space; zero: no side
    glm::dvec3 sky{0};       ///< radiance
    glm::dvec3 ground{0};    ///< radiance
};

/// An environment by nine coefficients of spherical harmonics: L00, L1-1, L10, L11, L2-2, L2-1, L20, L21,
/// L22.
struct HarmonicsLight {
    glm::dmat3 to_probe{1};  ///< eye space to the probe's axes
    std::array<glm::dvec3, 9> coefficients{};
    double scale = 1;
};

/// Ambient light at a surface, with what its accuracy hangs on.
struct AmbientLight {
    glm::dvec3 value{0};    ///< radiance
    glm::dvec3 largest{0};  ///< the sum of its absolute terms
    glm::dvec3 slope{0};    ///< at most so much per unit of error of the normal
};

/// The share of the sky that a surface at this angle (radians) from straight up sees: 1 - sin / 2 up to a
/// right angle and sin / 2 beyond it, exactly; (1 + cos) / 2 approximately. What is more or less than half
/// counts by the length of a normal that is interpolated as it is.
[[nodiscard]] double sky_share(Hemisphere kind, double angle, double length = 1);

/// mix(G, S, share of the sky). A zero normal sees half of each.
[[nodiscard]] AmbientLight hemisphere_light(Hemisphere kind, const HemisphereLight& light,
                                            const glm::dvec3& normal);

/// The irradiance of the nine coefficients on a surface facing the unit vector n of the probe's axes, as far
/// as the order goes; negative where a small bright light rings (Ramamoorthi and Hanrahan 2001, equation 13).
[[nodiscard]] glm::dvec3 irradiance(Harmonics order, const std::array<glm::dvec3, 9>& coefficients,
                                    const glm::dvec3& n);

/// max(scale irradiance, 0).
[[nodiscard]] AmbientLight harmonics_light(Harmonics order, const HarmonicsLight& light,
                                           const glm::dvec3& normal);

}  // namespace gobo::oracle
