// The picture of roughness, in its green channel, and metallic, in its blue one. Source: glTF 2.0, 3.9.2.

#piece none
/// What roughness (g) and metallic (b) are multiplied by.
vec3 metallicRoughnessTexel() { return vec3(1.0); }

#piece texture
#include <texture_placement>

/// Linear.
SAMPLER(7, sampler2D) metallicRoughnessMap;

/// What roughness (g) and metallic (b) are multiplied by.
vec3 metallicRoughnessTexel() { return texture(metallicRoughnessMap, mapCoordinate(1)).rgb; }
