// Shadows of directional lights (S15): the first DIRECTIONAL_SHADOWS of them have one map each.
//
// Model, source, edges: mapVisibility().
// Range:  eye space; result 0 to 1.
#include "shadow/one_map.glsl"
#include "shadow/parameters.glsl"

/// The share of directional light `i` that reaches the surface.
float directionalVisibility(int i) { return mapVisibility(shadows.shadows[i]); }
