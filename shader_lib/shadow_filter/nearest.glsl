// Shadows with hard edges (S15): the texel that holds the place decides, whatever the sampler's filter.
//
// Model:  one comparison.
// Source: Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978.
// Space:  window space of the light. Range: 0 to 1; result 0 or 1.
// Edges:  the far border belongs to the last texel.
#include "shadow/comparison.glsl"
#include "shadow/map_size.glsl"

/// The share of the light that gets through: all or nothing.
float filteredVisibility(vec3 place, float layer) {
    vec2 size = shadowMapSize();
    vec2 texel = min(floor(place.xy * size), size - 1.0);
    return compareDepth(vec3((texel + 0.5) / size, place.z), layer);
}
