// Diffuse light in bands of equal tone, as in a cartoon (S7).
//
// Model:  floor(N c) / N for N levels, at most (N - 1) / N: black is among the tones.
// Source: OpenGL 4 Shading Language Cookbook, ch. 3, Creating a Cartoon Shading Effect.
// Range:  cosine above 0, levels 1 to 64; result 0 to (N - 1) / N times the light.
// Edges:  a cosine of 1 or a rounding above it is in the top band, not in one more (H-T1); within an ulp of
//         k / N it is one of the two neighbouring bands (H-T2).
#include <diffuse/levels>
#include "diffuse/unlimited.glsl"

/// What is scattered of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) {
    float levels = float(toon.levels);
    return (min(floor(levels * cosine), levels - 1.0) / levels) * light;  // H-T1
}
