// Diffuse light by Lambert's law (S1).
//
// Model:  n.s where it is positive.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Diffuse Shading.
// Range:  cosine above 0, result the same times the light.
// Edges:  exactly 0 at a right angle; the caller asks only where n.s > 0 (S4).
#include "diffuse/unlimited.glsl"

/// What is scattered of a light that arrives at an angle of the given cosine to the normal.
vec3 diffuseTerm(float cosine, vec3 light) { return cosine * light; }
