// Two sides: where the back is seen, the normal is flipped (S11).
//
// Model:  n, or -n on the back.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, Implementing Two-sided Shading.
// Space:  eye. Range: unit or zero.
// Edges:  a zero normal has no sides (H-N1); which side is seen is isBackVisible()'s to say (H-G2).
#include "surface/normal.glsl"
#include "surface/side.glsl"

/// The unit normal that light is weighed against, on the side that is seen; zero where there is none.
vec3 visibleNormal() { return isBackVisible() ? -surfaceNormal() : surfaceNormal(); }
