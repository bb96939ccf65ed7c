// The shadows of the lights that the key counts (S15).
//
// Spaces, ranges: as each shadow's.
#include "shadow/shadow.glsl"

/// Of the directional lights that cast shadows, then of such spot lights, then of such point lights.
BLOCK(16, Shadows) {
    Shadow shadows[DIRECTIONAL_SHADOWS + SPOT_SHADOWS + POINT_SHADOWS];
} shadows;
