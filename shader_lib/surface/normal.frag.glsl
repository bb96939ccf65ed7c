// The surface's normal in the fragment stage: interpolated between unit normals and made unit again (E4).
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7: an interpolated normal is shorter than 1.
// Space:  eye.
// Edges:  where normals cancel each other it is zero: no light, ambient and emission only (H-N1).
#include "guards/unit_vector.glsl"

/// The unit normal of the surface in eye space; zero where there is none.
vec3 surfaceNormal() { return unitVector(eyeNormal); }
