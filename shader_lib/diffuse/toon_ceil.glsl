// Diffuse light in bands of equal tone, the brightest at full strength (S7).
//
// Model:  ceil(N c) / N for N levels, at most 1: black is not among the tones.
// Source: OpenGL 4 Shading Language Cookbook, ch. 3, Creating a Cartoon Shading Effect, which takes floor; ceil
//         is the other half of the same rule.
// Range:  cosine above 0, levels 1 to 64; result 1 / N to 1 times the light.
// Edges:  a cosine a rounding above 1 is in the top band, not in one more (H-T1); within an ulp of k / N it is
//         one of the two neighbouring bands (H-T2).
#include <diffuse/levels>
#include "diffuse/unlimited.glsl"

/// What is scattered of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) {
    float levels = float(toon.levels);
    return (min(ceil(levels * cosine), levels) / levels) * light;  // H-T1
}
