// Irradiance by spherical harmonics up to order 2 (S13), within 1 % of most environments'.
//
// Model:  c1 L22 (x^2 - y^2) + c3 L20 z^2 - c5 L20 + 2 c1 (L2-2 x y + L21 x z + L2-1 y z) and the terms of
//         order 0 and 1; c1 = 0.429043, c3 = 0.743125, c5 = 0.247708.
// Source: Ramamoorthi and Hanrahan, SIGGRAPH 2001, equation 13.
// Range:  not clamped: may be negative away from the light.
// Edges:  a surface without a normal gets the mean and -c5 L20 (H-N1).
#include "harmonics/normal.glsl"
#include "harmonics/to_first_order.glsl"

/// The irradiance on the surface.
vec3 irradiance() {
    vec3 n = probeNormal();
    vec3 crossed = harmonics.coefficients[4] * (n.x * n.y) + harmonics.coefficients[7] * (n.x * n.z) +
                   harmonics.coefficients[5] * (n.y * n.z);
    vec3 squares = 0.429043 * ((n.x - n.y) * (n.x + n.y)) * harmonics.coefficients[8] +
                   (0.743125 * n.z * n.z - 0.247708) * harmonics.coefficients[6];
    return irradianceToFirstOrder(n) + squares + 0.858086 * crossed;
}
