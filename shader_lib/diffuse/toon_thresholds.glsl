// Diffuse light in three tones, each above a threshold of its own (S8).
//
// Model:  the tone of the first threshold that the cosine exceeds, else none; over several lights
//         min(sum of t_i L_i, t max L_i): the tones add, but no more than the brightest tone t of the
//         brightest of the lights that give a tone, per channel.
// Source: Lighthouse3D, GLSL Tutorial, Toon Shader, with thresholds 0.95, 0.5, 0.25; its darkest tone is the
//         ambient light's.
// Range:  cosine above 0, thresholds and tones 0 to 1, the highest threshold first; result 0 to t max L_i.
// Edges:  a cosine exactly at a threshold does not exceed it, within an ulp it is one of the two neighbouring
//         tones (H-T2); at a cosine of 1 or a rounding above it there is no tone beyond the first (H-T1); a
//         threshold of 0 is exceeded by every light in front.
#include <diffuse/tones>

/// The brightest light so far that gives a tone, per channel.
vec3 brightestLight;

/// Prepares the sum of a point's scattered light. To be called before the first light.
void beginDiffuse() { brightestLight = vec3(0.0); }

/// The tone of a cosine.
float toneOf(float cosine) {
    if (cosine > toon.thresholds.x) return toon.tones.x;
    if (cosine > toon.thresholds.y) return toon.tones.y;
    return cosine > toon.thresholds.z ? toon.tones.z : 0.0;
}

/// What is scattered of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) {
    float tone = toneOf(cosine);
    if (tone > 0.0) brightestLight = max(brightestLight, light);
    return tone * light;
}

/// The scattered light that remains of the sum of all terms.
vec3 limitedDiffuse(vec3 total) {
    float brightestTone = max(toon.tones.x, max(toon.tones.y, toon.tones.z));
    return min(total, brightestTone * brightestLight);
}
