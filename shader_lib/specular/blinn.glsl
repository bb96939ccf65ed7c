// Highlights by Blinn's model (S3): wider than Phong's at the same exponent, about m_blinn = 4 m_phong.
//
// Model:  max(h.n, 0)^m with h = (s + v) / |s + v|.
// Source: Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977; OpenGL
//         Programming Guide, 9th ed., ch. 7.
// Space:  eye. Ranges: n and s unit, shininess 0 to 1e6; factor 0 to 1.
// Edges:  no highlight from a light exactly behind the viewer's ray (H-N4), except at shininess 0, where the
//         factor is 1 for every direction (H-S1); only called where n.s > 0 (S4, H-S4).
#include <power/highlight>
#include <shading/halfway>
#include "specular/highlights.glsl"

/// Prepares what all highlights share. To be called before the first light.
void beginHighlights() {
    beginHalfways();
    reflected = emptySum();
}

/// Adds the highlight of a light from the direction `toLight`, unit where the key has directions made so.
void addHighlight(vec3 normal, vec3 toLight, vec3 light) {
    float versine = versineOfHighlight(normal, toLight);
    addTerm(reflected, highlightPower(versine, material.shininess) * light);
}
