// Highlights by the model that a switch chooses at run time (L8).
//
// Model:  that of the chosen highlight.
// Source: as the highlights'.
// Space:  eye. Edges: as the highlights'; an unknown number is no highlight.
#include "specular/blinn.glsl" with addHighlight as addBlinnHighlight, beginHighlights as beginBlinn
#include "specular/phong.glsl" with addHighlight as addPhongHighlight, beginHighlights as beginPhong
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
