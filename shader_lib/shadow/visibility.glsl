// How much of a light reaches the surface past what stands between: the lookup of a shadow map (S15).
//
// Model:  (x, y, z) / w looked up and compared, the division explicit.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Shadow Mapping; Everitt, Projective Texture Mapping (2001).
// Space:  clip space of the light, scaled to 0 to 1. Range: any; result 0 to 1.
// Edges:  what lies behind the light (w < 0) is not in shadow, although its mirror image in the map may be
//         (H-W1), nor what lies beside, before or behind all that the map shows: of a negative w no number lies
//         between 0 and it. Only what lies within is divided, so no quotient leaves 0 to 1.
#include <shadow_filter>

/// The share of the light that reaches what projects to the place, before the division by w.
float visibility(vec4 projected, float layer) {
    float w = projected.w;
    bool isBeside = any(lessThan(projected.xyz, vec3(0.0))) || any(greaterThan(projected.xyz, vec3(w)));
    if (isBeside || w == 0.0) return 1.0;  // H-W1
    return filteredVisibility(projected.xyz / w, layer);
}
