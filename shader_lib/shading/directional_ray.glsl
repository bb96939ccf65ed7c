// The direction to a directional light, the same everywhere: a constant that needs no interpolation.

#include "directional/lights.glsl"

/// The unit vector to light number i (zero: no light).
vec3 directionalRay(int i) { return directionalLights.lights[i].direction; }

#piece hybrid.frag
#include "directional/lights.glsl"
#include "shading/light_number.glsl"

/// The unit vector to light number i (zero: no light).
vec3 directionalRay(int i) {
    lightNumber = i;
    return directionalLights.lights[i].direction;
}
