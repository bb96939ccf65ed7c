// How a homogeneous light reaches the surface: as a directional light where its w is 0, else as a point light (L6).
//
// Model:  w = 0: s along (x, y, z), no attenuation (L3); otherwise a point light at (x, y, z) / w (L4).
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Shading with a Directional Light Source.
// Space:  eye. Ranges: components within 1e6.
// Edges:  |w| below 2^-20 counts as 0; a light at the surface's own position and a zero direction give no
//         light (H-L1).
#include <guards/polar>
#include "lighting/attenuation.glsl"
#include "shading/light_ray.glsl"
#include "surface/position.glsl"

/// The ray to a light at a point in eye space, times its w, or in a direction of any length, w being 0.
LightRay eitherRay(vec4 position, vec3 coefficients) {
    float w = position.w;
    bool isLocal = abs(w) >= 9.5367431640625e-7;
    vec4 ray = directionAndLength(isLocal ? position.xyz / w - surfacePosition() : position.xyz);
    float fading = isLocal ? attenuation(coefficients, ray.w) : 1.0;
    return LightRay(ray.xyz, fading, fading);
}
