// One side: the surface is shaded as its normal has it, from wherever it is seen (E4; S11 is not asked for).
//
// Model:  n.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Lighting Introduction.
// Space:  eye.
// Range:  as surfaceNormal().
// Edges:  as surfaceNormal(): zero where there is none (H-N1).
#include "surface/normal.glsl"

/// The unit normal that light is weighed against; zero where there is none.
vec3 visibleNormal() { return surfaceNormal(); }
