// The picture of the base colour and its alpha, linear. Source: glTF 2.0, 3.9.2.

#piece none
/// What the base colour is multiplied by.
vec4 baseColorTexel() { return vec4(1.0); }

#piece texture
#include <texture_placement>

/// Linear: an sRGB picture is a GL_SRGB8_ALPHA8 texture.
SAMPLER(6, sampler2D) baseColorMap;

/// What the base colour is multiplied by.
vec4 baseColorTexel() { return texture(baseColorMap, mapCoordinate(0)); }
