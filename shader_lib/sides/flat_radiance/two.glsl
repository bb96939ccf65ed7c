// The radiance of a face of which one vertex is shaded on both sides (S11, E1).
//
// Model:  L of the provoking vertex, front or back.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Using Flat Shading, Implementing Two-sided Shading.
// Range:  as litSurface().
// Edges:  as isBackVisible().
#include "surface/side.glsl"

/// The radiance of the face's provoking vertex, of the side that is seen.
vec3 faceRadiance() { return isBackVisible() ? flatBackRadiance : flatRadiance; }
