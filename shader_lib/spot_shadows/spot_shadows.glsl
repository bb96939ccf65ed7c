// Shadows of spot lights: the first SPOT_SHADOWS of them have one map each, with the light's perspective.

#include "shadow/one_map.glsl"
#include "shadow/parameters.glsl"

/// How much of spot light `i` reaches the surface.
float spotVisibility(int i) { return mapVisibility(shadows.shadows[DIRECTIONAL_SHADOWS + i]); }
