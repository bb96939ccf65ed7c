// Highlights by Phong's model (S2).
//
// Model:  max(r.v, 0)^m with r = 2 (n.s) n - s.
// Source: Phong, Illumination for Computer Generated Pictures, CACM 18 (1975); OpenGL 4 Shading Language
//         Cookbook, ch. 2, Implementing Per-vertex Ambient, Diffuse and Specular Shading.
// Space:  eye. Ranges: n and s unit, shininess 0 to 1e6; factor 0 to 1.
// Edges:  at shininess 0 the factor is 1 for every direction (H-S1); only called where n.s > 0 (S4, H-S4).
#include <normal/versine>
#include <power/highlight>
#include <viewer>
#include "specular/highlights.glsl"

/// The unit vector to the viewer.
vec3 toViewer;

/// Prepares what all highlights share. To be called before the first light.
void beginHighlights() {
    toViewer = towardViewer();
    reflected = emptySum();
}

/// Adds the highlight of a light from the direction `toLight`, unit where the key has directions made so.
void addHighlight(vec3 normal, vec3 toLight, vec3 light) {
    vec3 mirrored = reflect(-toLight, normal);
    addTerm(reflected, highlightPower(highlightVersine(mirrored, toViewer), material.shininess) * light);
}
