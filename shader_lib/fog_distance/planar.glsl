// Fog by the depth in front of the viewer (F4): cheaper, but the fog thins towards the picture's corners.
//
// Model:  z = |p.z|.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog: abs(position.z).
// Space:  eye.
// Edges:  none: finite for any finite position.
#include "surface/position.glsl"

/// How much fog lies before the surface, as a distance; not negative.
float fogDistance() { return abs(surfacePosition().z); }
