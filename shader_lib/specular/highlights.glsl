// The sum of the highlights, and what they share: the viewer and the material.
//
// Model:  strength K_s sum f_s L (S5), not modulated by the surface's colour.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Specular Highlights.
// Space:  eye. Ranges: as the material's; result linear and unclamped.
#include <material>
#include "light_sum/plain.glsl"
#include "viewer/local.glsl"

/// The unit vector to the viewer, and the reflected light so far.
vec3 toViewer;
LightSum reflected;

/// Prepares what all highlights share. To be called before the first light.
void beginHighlights() {
    toViewer = towardViewer();
    reflected = emptySum();
}

/// The radiance of all highlights.
vec3 highlightRadiance() { return (material.strength * material.specular) * totalOf(reflected); }
