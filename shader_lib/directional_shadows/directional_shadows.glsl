// Shadows of directional lights: the first DIRECTIONAL_SHADOWS of them have one map each.

#include "shadow/one_map.glsl"
#include "shadow/parameters.glsl"

/// The share of directional light `i` that reaches the surface.
float directionalVisibility(int i) { return mapVisibility(shadows.shadows[i]); }
