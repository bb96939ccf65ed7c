// Diffuse light by the law that a switch chooses at run time (L8).
//
// Model:  that of the chosen law.
// Source: as the laws'.
// Range:  as the laws'; an unknown number is Lambert's law.
// Edges:  as the laws'.
#include "diffuse/unlimited.glsl" with beginDiffuse as beginUnlimited, limitedDiffuse as unlimitedDiffuse
#include "diffuse/lambert.glsl" with diffuseTerm as lambertTerm
#include "diffuse/toon.glsl" with diffuseTerm as toonTerm
#include "diffuse/toon_ceil.glsl" with diffuseTerm as toonCeilTerm
#include "diffuse/toon_thresholds.glsl" with beginDiffuse as beginTones, diffuseTerm as toneTerm, limitedDiffuse as limitedTones
#include "uber/switches.glsl"

/// Prepares the sum of a point's scattered light. To be called before the first light.
void beginDiffuse() {
    beginUnlimited();
    beginTones();
}

/// What is scattered of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) {
    if (switches.diffuse == 1) return toonTerm(cosine, light);
    if (switches.diffuse == 2) return toonCeilTerm(cosine, light);
    if (switches.diffuse == 3) return toneTerm(cosine, light);
    return lambertTerm(cosine, light);
}

/// The scattered light that remains of the sum of all terms.
vec3 limitedDiffuse(vec3 total) { return switches.diffuse == 3 ? limitedTones(total) : unlimitedDiffuse(total); }
