// The shadows of the lights that the key counts (S15).
//
// Model:  M p and, of a point light, a + b / w.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Shadow Mapping.
// Spaces, ranges: as each shadow's.
// Edges:  visibility() tells what w = 0 means (H-W1).
#include "shadow/shadow.glsl"

/// Of the directional lights that cast shadows, then of such spot lights, then of such point lights.
BLOCK(16, Shadows) {
    Shadow shadows[DIRECTIONAL_SHADOWS + SPOT_SHADOWS + POINT_SHADOWS];
} shadows;
