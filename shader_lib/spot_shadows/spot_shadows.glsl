// Shadows of spot lights: the first SPOT_SHADOWS of them have one map each, with the light's perspective.

#include "shadow/one_map.glsl"
#include "shadow/parameters.glsl"

/// The share of spot light `i` that reaches the surface.
float spotVisibility(int i) { return mapVisibility(shadows.shadows[DIRECTIONAL_SHADOWS + i]); }
