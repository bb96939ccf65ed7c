// A cosine to the front's normal, as a switch has one side or two (L8, S11).
//
// Model:  that of the chosen sides.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Two-sided Shading.
// Range:  -1 to 1.
// Edges:  as the sides'.
#include "sides/cosine.glsl" with cosineOfSide as cosineOfVisibleSide
#include "uber/switches.glsl"

/// The cosine to the normal that light is weighed against.
float cosineOfSide(float cosine) { return switches.sides == 0 ? cosine : cosineOfVisibleSide(cosine); }
