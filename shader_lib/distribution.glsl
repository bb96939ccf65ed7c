// The distribution of microfacets' normals: D = a^2 / (pi ((1 - a^2) sin^2 + a^2)^2), the angle between the normal n and the
// half vector h = (l + v) / |l + v|, a the slope's width alpha. In this form no 1 - cos^2 is left to cancel.
//
// Source: Trowbridge, Reitz, Average Irregularity Representation of a Rough Surface, JOSA 65 (1975); Walter et al. 2007, eq. 33;
//         glTF 2.0, appendix B.3.

#piece cross_product
// sin^2 = |n x (l + v)|^2 / |l + v|^2 (Lagrange's identity): relative accuracy at the peak, where 1 - (n.h)^2 is off by a
// rounding of 1, that is by 2 2^-24 / alpha^2 of the peak.
#include "distribution/of_sine.glsl"
#include "pbr/surface.glsl"

/// D of the half vector along `sum`, the sum of the directions to light and viewer; `square` is its squared length.
float normalDistribution(vec3 normal, float alpha, vec3 toLight, vec3 sum, float square) {
    vec3 across = cross(normal, toLight) + cross(normal, surface.toViewer);
    return distributionOf(alpha, min(dot(across, across) / square, 1.0));
}

#piece plain
// sin^2 = 1 - (n.h)^2: as good for a roughness of 0.3 and more, some instructions cheaper.
#include "distribution/of_sine.glsl"
#include "pbr/surface.glsl"

/// D of the half vector along `sum`, the sum of the directions to light and viewer; `square` is its squared length.
float normalDistribution(vec3 normal, float alpha, vec3 toLight, vec3 sum, float square) {
    float nh = dot(normal, sum) * inversesqrt(square);
    return distributionOf(alpha, max(1.0 - nh * nh, 0.0));  // guard: rounded out of its range
}

#piece of_sine
/// D at a squared sine of 0 to 1.
float distributionOf(float alpha, float sineSquared) {
    float square = alpha * alpha;
    float spread = (1.0 - square) * sineSquared + square;
    return square / (3.1415927 * spread * spread);
}
