// Shadows with bilinear percentage closer filtering (S15): of the four texels around, the share that is lit.
//
// Model:  the four comparisons, not the depths, weighted as bilinear filtering weighs texels.
// Source: Reeves, Salesin, Cook, Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987.
// Space:  window space of the light. Range: 0 to 1, result the same.
// Edges:  continuous from texel to texel; weights are floats, where a sampler's own have 8 bits; texels beyond
//         the border are those at the border.
#include "shadow/comparison.glsl"
#include "shadow/map_size.glsl"

/// The share of the light that gets through.
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
