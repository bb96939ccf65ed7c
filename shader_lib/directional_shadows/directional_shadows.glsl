// Shadows of directional lights: the first DIRECTIONAL_SHADOWS of them have one map each.

#include "shadow/one_map.glsl"
#include "shadow/parameters.glsl"

/// How much of directional light `i` reaches the surface.
float directionalVisibility(int i) { return mapVisibility(shadows.shadows[i]); }
