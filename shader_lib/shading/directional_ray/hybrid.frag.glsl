// The direction of a directional light with hybrid shading (E3): a constant needs no interpolation (L3).
//
// Space:  eye. Range: unit or zero.
#include "directional/lights.glsl"
#include "shading/light_number.glsl"

/// The unit vector to light number i (zero: no light).
vec3 directionalRay(int i) {
    lightNumber = i;
    return directionalLights.lights[i].direction;
}
