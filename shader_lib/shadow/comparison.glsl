// One comparison with a shadow map (S15).
//
// Model:  1 where the reference depth is at most the stored one, else 0.
// Source: OpenGL 4.5 core specification, 8.23, Texture Comparison Modes.
// Spaces: `place` in window space of the light, 0 to 1.
// Edges:  the level is given, so that lookups stand in branches and in vertex stages alike.
#include "shadow/maps.glsl"

/// How the maps' own filter answers for the place: xy where, z the depth that is compared.
float compareDepth(vec3 place, float layer) {
    return textureGrad(shadowMaps, vec4(place.xy, layer, place.z), vec2(0.0), vec2(0.0));
}
