// The surface's normal in the vertex stage (E2, E4).
//
// Model:  n = N x / |N x| with N the inverse transpose of the model-view matrix.
// Spaces: attribute `normal` in object space, result in eye space. Range: normals of any length.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2.
// Edges:  a zero normal stays zero: no light, ambient and emission only (H-N1, H-G1).
#include <guards/unit_vector>
#include "surface/transform.vert.glsl"

ATTRIBUTE(1) vec3 normal;

/// The unit normal of the surface in eye space; zero where there is none.
vec3 surfaceNormal() { return unitVector(transform.normalMatrix * normal); }
