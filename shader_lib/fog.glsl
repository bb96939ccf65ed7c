// What is seen of a surface through fog: f L + (1 - f) C, f the fog factor, L the surface's radiance, C the fog's.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog.
// Edges:  GLSL allows exp() an error of three roundings even at 0: without a limit the fog factor could exceed 1, and
//         subtract the fog's colour.

#piece none
// Clear air.
/// The radiance that is seen.
vec3 throughFog(vec3 radiance) { return radiance; }

#piece linear
// Linear: f = (end - z) / (end - start) within [0, 1]. start = end is a step: clear before, hidden from there on.
#include <fog_distance>
#include "fog/blend.glsl"

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) {
    float ahead = fog.end - fogDistance();
    float depth = fog.end - fog.start;
    if (depth == 0.0) return blendFog(radiance, ahead > 0.0 ? 1.0 : 0.0);  // guard: fog that is a step
    return blendFog(radiance, clamp(ahead / depth, 0.0, 1.0));
}

#piece exponential
// Constant density, the law of Beer and Lambert: f = exp(-density z).
#include <fog_distance>
#include "fog/blend.glsl"

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) { return blendFog(radiance, min(exp(-fog.density * fogDistance()), 1.0)); }

#piece exponential_squared
// Thin nearby, closing quickly further on: f = exp(-(density z)^2).
#include <fog_distance>
#include "fog/blend.glsl"

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) {
    float thickness = min(fog.density * fogDistance(), 16.0);  // guard: the square does not overflow
    return blendFog(radiance, min(exp(-thickness * thickness), 1.0));
}

#piece blend
/// The fog's colour; the density of exponential fog; where linear fog begins and where it hides everything.
BLOCK(3, Fog) {
    vec3 color;
    float density;
    float start;
    float end;
} fog;

/// The radiance that is seen: the surface's where the fog factor is 1, the fog's colour where it is 0.
vec3 blendFog(vec3 radiance, float fogFactor) {
    return fogFactor > 1e-30 ? mix(fog.color, radiance, fogFactor) : fog.color;  // guard: infinite radiance
}
