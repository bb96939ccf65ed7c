// Highlights by the model that a switch chooses at run time; an unknown number is no highlight.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_blinn
#define addHighlight addBlinnHighlight
#define beginHighlights beginBlinn

#piece as_phong
#undef addHighlight
#undef beginHighlights
#define addHighlight addPhongHighlight
#define beginHighlights beginPhong

#piece as_itself
#undef addHighlight
#undef beginHighlights

#piece switched
#include "specular/as_blinn.glsl"
#include "specular/blinn.glsl"
#include "specular/as_phong.glsl"
#include "specular/phong.glsl"
#include "specular/as_itself.glsl"
#include "uber/switches.glsl"

/// Prepares what all highlights share. To be called before the first light.
void beginHighlights() {
    beginBlinn();
    beginPhong();
}

/// Adds the highlight of a light from the unit direction `toLight`.
void addHighlight(vec3 normal, vec3 toLight, vec3 light) {
    if (switches.specular == 1) addPhongHighlight(normal, toLight, light);
    if (switches.specular == 2) addBlinnHighlight(normal, toLight, light);
}
