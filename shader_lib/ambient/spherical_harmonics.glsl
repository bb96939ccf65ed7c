// Light of a whole environment, as nine coefficients of spherical harmonics (S13).
//
// Model:  A = max(scale E(n), 0), with E the irradiance polynomial as far as `harmonics` takes it.
// Source: Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH
//         2001; OpenGL Programming Guide, 9th ed., ch. 7, Lighting with Spherical Harmonics.
// Ranges: coefficients within 1e5, scale 0 to 1e3; 1 / pi makes A the radiance of a white surface.
// Edges:  a small bright light makes the polynomial negative on its far side: there A is 0 (H-B1). What that
//         adds to the probe's energy, energy_added_by_clamping() of gobo/light_probes.hpp tells.
#include <harmonics>

/// The light that arrives at the surface.
vec3 ambientLight() { return max(harmonics.scale * irradiance(), vec3(0.0)); }  // H-B1
