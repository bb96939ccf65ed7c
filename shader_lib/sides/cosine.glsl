// A cosine to the front's normal, as the side that is seen has it (S11).
//
// Model:  c, or -c on the back.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Two-sided Shading.
// Range:  -1 to 1.
// Edges:  which side is seen is isBackVisible()'s to say (H-G2).
#include "surface/side.glsl"

/// The cosine to the normal of the side that is seen.
float cosineOfSide(float cosine) { return isBackVisible() ? -cosine : cosine; }
