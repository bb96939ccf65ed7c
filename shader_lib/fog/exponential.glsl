// Fog of constant density (F2).
//
// Model:  f = exp(-density z), the law of Beer and Lambert.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog.
// Ranges: density 0 to 1e3, z not negative.
// Edges:  at any distance finite (H-F2): a huge product gives 0, the fog's colour. GLSL allows exp() three
//         roundings even at 0: what passes 1 would take more of the fog away than there is.
#include <fog_distance>
#include "fog/blend.glsl"

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) { return blendFog(radiance, min(exp(-fog.density * fogDistance()), 1.0)); }
