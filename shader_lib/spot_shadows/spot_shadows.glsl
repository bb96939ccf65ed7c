// Shadows of spot lights (S15): the first SPOT_SHADOWS of them have one map each, with the light's perspective.
//
// Model, source, edges: mapVisibility().
// Range:  eye space; result 0 to 1.
#include "shadow/one_map.glsl"
#include "shadow/parameters.glsl"

/// The share of spot light `i` that reaches the surface.
float spotVisibility(int i) { return mapVisibility(shadows.shadows[DIRECTIONAL_SHADOWS + i]); }
