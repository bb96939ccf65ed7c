// How a shadow map is looked up, in the light's window space of 0 to 1. Texels beyond the border are those at the border.

#piece bilinear
// Percentage closer: of the four texels around the comparisons, not the depths, weighted as bilinear filtering weighs
// texels. Weights are floats, where a sampler's own have 8 bits.
// Source: Reeves, Salesin, Cook, Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987.
#include "shadow/comparison.glsl"
#include "shadow/map_size.glsl"

/// How much of the light gets through.
float filteredVisibility(vec3 place, float layer) {
    vec2 size = shadowMapSize();
    vec2 among = place.xy * size - 0.5;
    vec2 corner = floor(among);
    vec2 weight = among - corner;
    vec2 low = (max(corner, 0.0) + 0.5) / size;
    vec2 high = (min(corner + 1.0, size - 1.0) + 0.5) / size;
    float lowRow = mix(compareDepth(vec3(low, place.z), layer),
                       compareDepth(vec3(high.x, low.y, place.z), layer), weight.x);
    float highRow = mix(compareDepth(vec3(low.x, high.y, place.z), layer),
                        compareDepth(vec3(high, place.z), layer), weight.x);
    return mix(lowRow, highRow, weight.y);
}

#piece sampler
// By the sampler: one lookup. With GL_LINEAR graphics processors answer as `bilinear` does, with weights of 8 bits as a
// rule; with GL_NEAREST it is one comparison.
#include "shadow/comparison.glsl"

/// How much of the light gets through.
float filteredVisibility(vec3 place, float layer) { return compareDepth(place, layer); }

#piece nearest
// Hard edges: the texel that holds the place decides, whatever the sampler's filter.
#include "shadow/comparison.glsl"
#include "shadow/map_size.glsl"

/// How much of the light gets through: all or nothing.
float filteredVisibility(vec3 place, float layer) {
    vec2 size = shadowMapSize();
    vec2 texel = min(floor(place.xy * size), size - 1.0);
    return compareDepth(vec3((texel + 0.5) / size, place.z), layer);
}
