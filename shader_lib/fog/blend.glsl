// What is seen of a surface through fog (F1, F2, F3).
//
// Model:  f L + (1 - f) C.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog.
// Ranges: clearness f 0 to 1; radiance linear and unclamped.
// Edges:  where nothing is seen of the surface, its radiance does not matter, an infinite one either (H-F3).
//         Below 1e-30 nothing is: an exponential may be off by 3 + 2 |x| ulp where it is 0, too.
#include "fog/parameters.glsl"

/// The radiance that is seen, of a surface's radiance behind fog of which `clearness` gets through.
vec3 blendFog(vec3 radiance, float clearness) {
    return clearness > 1e-30 ? mix(fog.color, radiance, clearness) : fog.color;  // H-F3
}
