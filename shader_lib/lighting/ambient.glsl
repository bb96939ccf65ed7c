// The ambient light that the surface scatters (L2).
//
// Model:  K_a A, with A as the feature `ambient` has it.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Ambient Light.
// Range:  linear and unclamped, not negative.
// Edges:  none: it reaches a surface without a normal, too (H-N1).
#include <ambient>
#include <material>
#include <vertex_color>

/// The radiance that the surface scatters of the ambient light.
vec3 ambientRadiance() { return tinted(material.ambient) * ambientLight(); }
