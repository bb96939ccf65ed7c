// The irradiance polynomial up to its linear terms (S13).
//
// Model:  c4 L00 + 2 c2 (L11 x + L1-1 y + L10 z), c2 = 0.511664, c4 = 0.886227.
// Source: Ramamoorthi and Hanrahan, SIGGRAPH 2001, equation 13.
// Space:  the probe's axes. Range: n unit or zero.
// Edges:  a surface without a normal gets the mean (H-N1).
#include "harmonics/coefficients.glsl"

/// The terms of order 0 and 1 on a surface that faces n.
vec3 irradianceToFirstOrder(vec3 n) {
    vec3 linear = harmonics.coefficients[3] * n.x + harmonics.coefficients[1] * n.y + harmonics.coefficients[2] * n.z;
    return 0.886227 * harmonics.coefficients[0] + 1.023328 * linear;
}
