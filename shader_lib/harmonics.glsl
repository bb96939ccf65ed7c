// Irradiance of an environment by spherical harmonics, up to the order that is asked for: 2 is within 1 % of most
// environments, 1 is light from one side, 0 their mean.
//
// Model:  c1 L22 (x^2 - y^2) + c3 L20 z^2 - c5 L20 + 2 c1 (L2-2 x y + L21 x z + L2-1 y z)
//         + c4 L00 + 2 c2 (L11 x + L1-1 y + L10 z); c1 = 0.429043, c2 = 0.511664, c3 = 0.743125, c4 = 0.886227,
//         c5 = 0.247708.
// Source: Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001,
//         equation 13. Ten published probes are in gobo/light_probes.hpp.
// Edges:  may be negative away from the light: the caller clamps it. A surface without a normal gets the mean, less
//         c5 L20 with order 2.

#piece second
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

#piece first
#include "harmonics/normal.glsl"
#include "harmonics/to_first_order.glsl"

/// The irradiance on the surface.
vec3 irradiance() { return irradianceToFirstOrder(probeNormal()); }

#piece zeroth
#include "harmonics/coefficients.glsl"

/// The irradiance on the surface.
vec3 irradiance() { return 0.886227 * harmonics.coefficients[0]; }

#piece to_first_order
#include "harmonics/coefficients.glsl"

/// The terms of order 0 and 1 on a surface that faces n.
vec3 irradianceToFirstOrder(vec3 n) {
    vec3 linear = harmonics.coefficients[3] * n.x + harmonics.coefficients[1] * n.y + harmonics.coefficients[2] * n.z;
    return 0.886227 * harmonics.coefficients[0] + 1.023328 * linear;
}

#piece normal
#include <sides>
#include "harmonics/coefficients.glsl"

/// The unit normal of the side that is seen, in the probe's axes.
vec3 probeNormal() { return harmonics.toProbe * visibleNormal(); }

#piece coefficients
// Coefficients within 1e5, scale 0 to 1e3; `toProbe` is a rotation.
/// Coefficients in the order L00, L1-1, L10, L11, L2-2, L2-1, L20, L21, L22; `toProbe` rotates directions from
/// eye space to the probe's axes (the inverse of the view's rotation where these are the world's).
BLOCK(21, Harmonics) {
    mat3 toProbe;
    vec3 coefficients[9];
    float scale;
} harmonics;
