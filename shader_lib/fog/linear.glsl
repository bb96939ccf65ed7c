// Fog that thickens evenly from a near distance, where it begins, to a far one, where it hides all (F1).
//
// Model:  f = (far - z) / (far - near), clamped to [0, 1].
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog.
// Ranges: near, far and z not negative.
// Edges:  near = far is a step: clear before that distance, hidden from it on (H-F1).
#include <fog_distance>
#include "fog/blend.glsl"

/// The radiance that is seen.
vec3 throughFog(vec3 radiance) {
    float ahead = fog.far - fogDistance();
    float depth = fog.far - fog.near;
    if (depth == 0.0) return blendFog(radiance, ahead > 0.0 ? 1.0 : 0.0);  // H-F1
    return blendFog(radiance, clamp(ahead / depth, 0.0, 1.0));
}
