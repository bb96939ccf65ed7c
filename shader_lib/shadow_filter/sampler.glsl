// Shadows filtered by the sampler (S15): one lookup. With GL_LINEAR graphics processors answer as `bilinear`
// does, with weights of 8 bits as a rule; with GL_NEAREST it is one comparison.
//
// Model:  as the sampler's state says.
// Source: OpenGL 4.5 core specification, 8.23.1: with GL_LINEAR the comparisons are weighted, how exactly is
//         left open.
// Space:  window space of the light. Range: 0 to 1, result the same.
// Edges:  as the driver's: beside a map visibility() does not ask.
#include "shadow/comparison.glsl"

/// The share of the light that gets through.
float filteredVisibility(vec3 place, float layer) { return compareDepth(place, layer); }
