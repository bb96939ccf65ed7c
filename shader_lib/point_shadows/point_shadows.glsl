// Shadows of point lights: the first POINT_SHADOWS of them have six maps each, the faces of a cube.

#include "shadow/parameters.glsl"
#include "shadow/six_maps.glsl"

/// How much of point light `i` reaches the surface.
float pointVisibility(int i) { return cubeVisibility(shadows.shadows[DIRECTIONAL_SHADOWS + SPOT_SHADOWS + i]); }
