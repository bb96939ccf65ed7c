// The sum of the highlights, and what they share: the material.
//
// Model:  strength K_s sum f_s L (S5), not modulated by the surface's colour.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Specular Highlights.
// Ranges: as the material's; result linear and unclamped.
// Edges:  no highlights give exactly 0.
#include <light_sum>
#include <material>

/// The reflected light so far.
LightSum reflected;

/// The radiance of all highlights.
vec3 highlightRadiance() { return (material.strength * material.specular) * totalOf(reflected); }
