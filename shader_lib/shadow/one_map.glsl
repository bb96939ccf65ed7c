// The shadow of a light with one map: a directional light's, or a spot light's with its perspective (S15).
//
// Model:  the eye-space position, multiplied by the light's matrix at each place where light is computed. A
//         matrix costs twelve multiplications; a varying for each map would take 4 of the 60 components that
//         are guaranteed, and make a vertex stage of its own for each number of shadows.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Shadow Mapping.
// Space:  eye. Edges: as visibility(): no shadow behind a spot light (H-W1), nor beside its map, which a cone
//         may be wider than.
#include "shadow/shadow.glsl"
#include "shadow/visibility.glsl"
#include "surface/position.glsl"

/// The share of the light that reaches the surface.
float mapVisibility(Shadow shadow) { return visibility(shadow.toMap * vec4(surfacePosition(), 1.0), shadow.layer); }
