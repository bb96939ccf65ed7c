// What becomes of a direction that was interpolated between unit vectors: it is made unit again (E4).
//
// Model:  n / |n|.
// Source: OpenGL Programming Guide, 9th ed., ch. 7: an interpolated normal is shorter than 1.
// Space:  any. Range: as unitVector().
// Edges:  where the vectors cancel each other it is zero: no light from there (H-N1).
#include <guards/unit_vector>

/// The direction to shade with.
vec3 shadingDirection(vec3 interpolated) { return unitVector(interpolated); }
