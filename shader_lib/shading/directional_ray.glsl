// The direction of a directional light: the same everywhere (L3).
//
// Model:  s constant.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Directional Light.
// Space:  eye. Range: unit or zero.
// Edges:  a direction of zero is a light from nowhere (H-L1).
#include "directional/lights.glsl"

/// The unit vector to light number i (zero: no light).
vec3 directionalRay(int i) { return directionalLights.lights[i].direction; }
