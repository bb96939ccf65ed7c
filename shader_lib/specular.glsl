// Highlights: strength K_s sum f_s L, not tinted by the surface's colour. Only evaluated where n.l > 0.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Specular Highlights.
// Edges:  at shininess 0 the factor is 1 for every direction.

#piece none
/// Prepares what all highlights share: nothing.
void beginHighlights() {}

/// Adds a light's highlight: none.
void addHighlight(vec3 normal, vec3 toLight, vec3 light) {}

/// The radiance of all highlights.
vec3 highlightRadiance() { return vec3(0.0); }

#piece phong
// Phong: max(r.v, 0)^m with r = 2 (n.l) n - l. Source: Phong, Illumination for Computer Generated Pictures, CACM 18 (1975).
#include <normal/one_minus_cosine>
#include <power/highlight>
#include <viewer>
#include "specular/highlights.glsl"

/// The unit vector to the viewer.
vec3 toViewer;

/// Prepares what all highlights share. To be called before the first light.
void beginHighlights() {
    toViewer = towardViewer();
    specularSum = emptySum();
}

/// Adds the highlight of a light from the direction `toLight`, unit where the key has directions made so.
void addHighlight(vec3 normal, vec3 toLight, vec3 light) {
    vec3 mirrored = reflect(-toLight, normal);
    addTerm(specularSum, highlightPower(highlightOneMinusCosine(mirrored, toViewer), material.shininess) * light);
}

#piece blinn
// Blinn: max(h.n, 0)^m with h = (l + v) / |l + v|, wider than Phong's at the same exponent, about m_blinn = 4 m_phong. None
// from a light exactly behind the viewer's ray.
// Source: Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977.
#include <power/highlight>
#include <shading/halfway>
#include "specular/highlights.glsl"

/// Prepares what all highlights share. To be called before the first light.
void beginHighlights() {
    beginHalfways();
    specularSum = emptySum();
}

/// Adds the highlight of a light from the direction `toLight`, unit where the key has directions made so.
void addHighlight(vec3 normal, vec3 toLight, vec3 light) {
    float oneMinusCosine = oneMinusCosineOfHighlight(normal, toLight);
    addTerm(specularSum, highlightPower(oneMinusCosine, material.shininess) * light);
}

#piece highlights
#include <light_sum>
#include <material>

/// The specular light so far.
LightSum specularSum;

/// The radiance of all highlights.
vec3 highlightRadiance() { return (material.strength * material.specular) * totalOf(specularSum); }
