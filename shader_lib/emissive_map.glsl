// The picture of what the surface emits, linear. Source: glTF 2.0, 3.9.3.

#piece none
/// What the emission is multiplied by.
vec3 emissiveTexel() { return vec3(1.0); }

#piece texture
#include <texture_placement>

/// Linear: an sRGB picture is a GL_SRGB8 texture.
SAMPLER(10, sampler2D) emissiveMap;

/// What the emission is multiplied by.
vec3 emissiveTexel() { return texture(emissiveMap, mapCoordinate(4)).rgb; }
