// Diffuse light by the model that a switch chooses at run time; an unknown number is Lambert's.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_unlimited
#define beginDiffuse beginUnlimited
#define limitedDiffuse unlimitedDiffuse

#piece as_lambert
#undef beginDiffuse
#undef limitedDiffuse
#define diffuseTerm lambertTerm

#piece as_toon
#undef diffuseTerm
#define diffuseTerm toonTerm

#piece as_toon_ceil
#undef diffuseTerm
#define diffuseTerm toonCeilTerm

#piece as_toon_thresholds
#undef diffuseTerm
#define beginDiffuse beginTones
#define diffuseTerm toneTerm
#define limitedDiffuse limitedTones

#piece as_itself
#undef beginDiffuse
#undef diffuseTerm
#undef limitedDiffuse

#piece switched
#include "diffuse/as_unlimited.glsl"
#include "diffuse/unlimited.glsl"
#include "diffuse/as_lambert.glsl"
#include "diffuse/lambert.glsl"
#include "diffuse/as_toon.glsl"
#include "diffuse/toon.glsl"
#include "diffuse/as_toon_ceil.glsl"
#include "diffuse/toon_ceil.glsl"
#include "diffuse/as_toon_thresholds.glsl"
#include "diffuse/toon_thresholds.glsl"
#include "diffuse/as_itself.glsl"
#include "uber/switches.glsl"

/// Prepares the sum of a point's diffuse light. To be called before the first light.
void beginDiffuse() {
    beginUnlimited();
    beginTones();
}

/// The diffuse reflection of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) {
    if (switches.diffuse == 1) return toonTerm(cosine, light);
    if (switches.diffuse == 2) return toonCeilTerm(cosine, light);
    if (switches.diffuse == 3) return toneTerm(cosine, light);
    return lambertTerm(cosine, light);
}

/// The diffuse light that remains of the sum of all terms.
vec3 limitedDiffuse(vec3 total) { return switches.diffuse == 3 ? limitedTones(total) : unlimitedDiffuse(total); }

#piece levels
#include "uber/toon.glsl"

#piece tones
#include "uber/toon.glsl"
