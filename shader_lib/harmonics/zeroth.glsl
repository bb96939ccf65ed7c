// Irradiance by spherical harmonics of order 0 (S13): the environment's mean, from everywhere alike.
//
// Model:  c4 L00, c4 = 0.886227.
// Source: Ramamoorthi and Hanrahan, SIGGRAPH 2001, equation 13.
// Range:  not clamped.
// Edges:  none: the light is the same whichever way the surface faces.
#include "harmonics/coefficients.glsl"

/// The irradiance on the surface.
vec3 irradiance() { return 0.886227 * harmonics.coefficients[0]; }
