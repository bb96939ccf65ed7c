// The radiance of a surface whose vertices are shaded on both sides: no vertex knows which side will be seen
// of the triangles that it belongs to (S11, E2).
//
// Model:  L of the front or of the back, interpolated between the vertices.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Two-sided Shading: FrontColor, BackColor.
// Range:  as litSurface(), or beyond by a rounding.
// Edges:  as isBackVisible(); the caller clamps what a rounding makes negative (H-I1).
#include "surface/side.glsl"

/// The radiance interpolated between the vertices, of the side that is seen.
vec3 interpolatedRadiance() { return isBackVisible() ? backRadiance : litRadiance; }
