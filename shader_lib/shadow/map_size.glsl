// How finely the shadow maps are divided (S15).
//
// Model:  the size of level 0.
// Source: OpenGL Shading Language 4.50, 8.9.1: textureSize().
// Range:  1 or more.
// Edges:  none: the same for all layers.
#include "shadow/maps.glsl"

/// Texels along each side of the maps.
vec2 shadowMapSize() { return vec2(textureSize(shadowMaps, 0).xy); }
