// Shadows of directional lights (S15): the first DIRECTIONAL_SHADOWS of them have one map each.
//
// Model:  the eye-space position, multiplied by the light's matrix at each place where light is computed. A
//         matrix costs twelve multiplications; a varying for each map would take 4 of the 60 components that
//         are guaranteed, and make a vertex stage of its own for each number of shadows.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Shadow Mapping.
// Space:  eye. Edges: as visibility().
#include "shadow/parameters.glsl"
#include "shadow/visibility.glsl"
#include "surface/position.glsl"

/// The share of directional light `i` that reaches the surface.
float directionalVisibility(int i) {
    Shadow shadow = shadows.shadows[i];
    return visibility(shadow.toMap * vec4(surfacePosition(), 1.0), shadow.layer);
}
