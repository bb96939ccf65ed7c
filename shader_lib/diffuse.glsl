// Diffuse reflection: what a surface sends to all sides of a light that falls on it at a cosine above 0.
//
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Diffuse Shading, ch. 3, Creating a Cartoon Shading
//         Effect; Lighthouse3D, GLSL Tutorial, Toon Shader.
// Edges:  within a rounding of a threshold, or of k / levels, a cosine has one of the two neighbouring tones; a cosine
//         that a rounding left above 1 has the brightest tone, not one more.

#piece lambert
// Lambert's law: the cosine.
#include "diffuse/unlimited.glsl"

/// The diffuse reflection of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) { return cosine * light; }

#piece toon
// Bands of equal tone, black among them: floor(N c) / N, at most (N - 1) / N.
#include "diffuse/levels.glsl"
#include "diffuse/unlimited.glsl"

/// The diffuse reflection of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) {
    float levels = float(toon.levels);
    return (min(floor(levels * cosine), levels - 1.0) / levels) * light;  // guard: cosine above 1
}

#piece toon_ceil
// Bands of equal tone, the brightest at full strength: ceil(N c) / N, at most 1.
#include "diffuse/levels.glsl"
#include "diffuse/unlimited.glsl"

/// The diffuse reflection of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) {
    float levels = float(toon.levels);
    return (min(ceil(levels * cosine), levels) / levels) * light;  // guard: cosine above 1
}

#piece toon_thresholds
// The tone of the first threshold that the cosine exceeds. The tones of several lights add, per channel to no more than
// the brightest tone of the brightest light that has one: min(sum t_i L_i, t max L_i).
#include "diffuse/tones.glsl"

/// The brightest light so far that gives a tone, per channel.
vec3 brightestLight;

/// Prepares the sum of a point's diffuse light. To be called before the first light.
void beginDiffuse() { brightestLight = vec3(0.0); }

/// The tone of a cosine.
float toneOf(float cosine) {
    if (cosine > toon.thresholds.x) return toon.tones.x;
    if (cosine > toon.thresholds.y) return toon.tones.y;
    return cosine > toon.thresholds.z ? toon.tones.z : 0.0;
}

/// The diffuse reflection of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) {
    float tone = toneOf(cosine);
    if (tone > 0.0) brightestLight = max(brightestLight, light);
    return tone * light;
}

/// The diffuse light that remains of the sum of all terms.
vec3 limitedDiffuse(vec3 total) {
    float brightestTone = max(toon.tones.x, max(toon.tones.y, toon.tones.z));
    return min(total, brightestTone * brightestLight);
}

#piece unlimited
// What Lambert's law and bands share: light adds up without bound.
/// Prepares the sum of a point's diffuse light: nothing.
void beginDiffuse() {}

/// The diffuse light that remains of the sum of all terms: all of it.
vec3 limitedDiffuse(vec3 total) { return total; }

#piece levels
/// The number of tones.
BLOCK(7, Toon) {
    int levels;
} toon;

#piece tones
/// Cosines, the highest first (0.95, 0.5, 0.25), and the tone above each (1, 0.6, 0.4).
BLOCK(14, ToonThresholds) {
    vec3 thresholds;
    vec3 tones;
} toon;
