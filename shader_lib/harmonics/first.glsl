// Irradiance by spherical harmonics up to order 1 (S13): from one side more than from the other.
//
// Model:  the polynomial without its square terms.
// Source: Ramamoorthi and Hanrahan, SIGGRAPH 2001, equation 13.
// Range:  not clamped: may be negative away from the light.
// Edges:  a surface without a normal gets the mean (H-N1).
#include "harmonics/normal.glsl"
#include "harmonics/to_first_order.glsl"

/// The irradiance on the surface.
vec3 irradiance() { return irradianceToFirstOrder(probeNormal()); }
