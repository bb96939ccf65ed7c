// The ambient light that a switch chooses at run time (L8).
//
// Model:  that of the chosen light.
// Source: as the lights'. Edges: as the lights'; an unknown number is light from everywhere alike.
// Range:  as the lights'.
#include "ambient/global.glsl" with ambientLight as globalLight
#include "ambient/hemisphere.glsl" with ambientLight as hemisphereLight
#include "ambient/image.glsl" with ambientLight as lightOfImage
#include "ambient/spherical_harmonics.glsl" with ambientLight as lightOfHarmonics
#include "uber/switches.glsl"

/// The ambient light that arrives at the surface.
vec3 ambientLight() {
    if (switches.ambient == 1) return hemisphereLight();
    if (switches.ambient == 2) return lightOfHarmonics();
    if (switches.ambient == 3) return lightOfImage();
    return globalLight();
}
