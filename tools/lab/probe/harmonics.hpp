// An environment as nine coefficients of spherical harmonics.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "lab/probe/environment.hpp"

namespace gobo::probe {

/// Coefficients of the radiance, in the order L00, L1-1, L10, L11, L2-2, L2-1, L20, L21, L22. The axes are
/// those of the environment: x, y and z of the polynomials are its own, y is up.
using Harmonics = std::array<glm::dvec3, 9>;

/// The integrals of L(w) Y(w) over all directions, over the texels' exact solid angles (Ramamoorthi and
/// Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001, equation 3).
[[nodiscard]] Harmonics project(const Environment& environment);

/// The irradiance on a surface that faces a unit vector, as the nine coefficients have it (equation 13): pi
/// times what a white surface scatters.
[[nodiscard]] glm::dvec3 irradiance(const Harmonics& harmonics, const glm::dvec3& normal);

/// Nine rows "probe,coefficient,red,green,blue" under a heading, as the published probes are kept.
[[nodiscard]] std::string to_csv(const Harmonics& harmonics, std::string_view name);

}  // namespace gobo::probe
