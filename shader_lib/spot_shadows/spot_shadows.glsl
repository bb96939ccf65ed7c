// Shadows of spot lights (S15): the first SPOT_SHADOWS of them have one map each, with the light's perspective.
//
// Model:  as for directional lights, with a division by w; a cone wider than the map is not in shadow beside it.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Shadow Mapping.
// Space:  eye. Edges: as visibility(): no shadow behind the light (H-W1).
#include "shadow/parameters.glsl"
#include "shadow/visibility.glsl"
#include "surface/position.glsl"

/// The share of spot light `i` that reaches the surface.
float spotVisibility(int i) {
    Shadow shadow = shadows.shadows[DIRECTIONAL_SHADOWS + i];
    return visibility(shadow.toMap * vec4(surfacePosition(), 1.0), shadow.layer);
}
