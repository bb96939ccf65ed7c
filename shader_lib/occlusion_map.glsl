// How much of the ambient light reaches the surface: 1 + strength (r - 1), r the picture's red channel. Source: glTF 2.0, 3.9.3.

#piece none
/// What the ambient light is multiplied by.
float ambientOcclusion() { return 1.0; }

#piece texture
#include <texture_placement>
#include "pbr/material.glsl"

/// Linear.
SAMPLER(9, sampler2D) occlusionMap;

/// What the ambient light is multiplied by.
float ambientOcclusion() { return 1.0 + material.occlusionStrength * (texture(occlusionMap, mapCoordinate(3)).r - 1.0); }
