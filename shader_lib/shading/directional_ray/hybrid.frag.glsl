// The direction of a directional light with hybrid shading (E3): a constant needs no interpolation (L3).
//
// Model:  s constant.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Directional Light.
// Space:  eye. Range: unit or zero.
// Edges:  a direction of zero is a light from nowhere (H-L1).
#include "directional/lights.glsl"
#include "shading/light_number.glsl"

/// The unit vector to light number i (zero: no light).
vec3 directionalRay(int i) {
    lightNumber = i;
    return directionalLights.lights[i].direction;
}
