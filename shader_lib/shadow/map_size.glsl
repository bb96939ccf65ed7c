// How finely the shadow maps are divided (S15).
#include "shadow/maps.glsl"

/// Texels along each side of the maps.
vec2 shadowMapSize() { return vec2(textureSize(shadowMaps, 0).xy); }
