// The surface's normal in the fragment stage: interpolated between unit normals (E4).
//
// Model:  n as shadingDirection() has it.
// Source: Phong, CACM 18 (1975).
// Space:  eye.
// Edges:  where normals cancel each other it is zero: no light, ambient and emission only (H-N1).
#include <normal>

/// The normal of the surface in eye space, unit where the key has it made so; zero where there is none.
vec3 surfaceNormal() { return shadingDirection(eyeNormal); }
