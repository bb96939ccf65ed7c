// The direction of a directional light: the same everywhere (L3).
//
// Space:  eye. Range: unit or zero.
#include "directional/lights.glsl"

/// The unit vector to light number i (zero: no light).
vec3 directionalRay(int i) { return directionalLights.lights[i].direction; }
