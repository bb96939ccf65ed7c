// Unlit: the base colour itself.
//
// Source: KHR_materials_unlit.

#include "pbr/base_color.glsl"

/// The radiance that leaves the surface towards the viewer, before fog.
vec3 litSurface() { return baseColor().rgb; }
