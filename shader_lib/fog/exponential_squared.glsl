// Fog that is thin nearby and closes quickly further on (F3).
//
// Model:  f = exp(-(density z)^2).
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog.
// Ranges: density 0 to 1e3, z not negative.
// Edges:  at any distance finite (H-F2): the exponential of -16^2 is 0 in a float, so the
//         product stops there. GLSL allows exp() three roundings even at 0: what passes 1 would
//         take more of the fog away than there is.
#include <fog_distance>
#include "fog/blend.glsl"

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) {
    float thickness = min(fog.density * fogDistance(), 16.0);  // H-F2: the square does not overflow
    return blendFog(radiance, min(exp(-thickness * thickness), 1.0));
}
