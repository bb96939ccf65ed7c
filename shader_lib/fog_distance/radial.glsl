// Fog by the distance to the viewer (F4): the same fog wherever the viewer looks.
//
// Model:  z = |p|.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Simulating Fog: the distance itself instead of its z.
// Space:  eye. Range: positions within 1e20.
// Edges:  the length does not overflow (H-F2).
#include <guards/vector_length>
#include "surface/position.glsl"

/// How much fog lies before the surface, as a distance; not negative.
float fogDistance() { return vectorLength(surfacePosition()); }
