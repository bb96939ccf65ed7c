// Light that comes from everywhere alike (L2).
//
// Model:  K_a A.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Ambient Light.
// Ranges: A 0 to 1e5 (radiance); result linear and unclamped.
#include "material/uniform.glsl"

/// The global ambient light A.
BLOCK(2, Ambient) {
    vec3 color;
} ambient;

/// The radiance that the surface reflects of the ambient light.
vec3 ambientRadiance() { return material.ambient * ambient.color; }
