// Radiance clamped to what a display of fixed range shows (L7: the texts clamp the sum).
//
// Model:  min(L, 1).
// Source: OpenGL Programming Guide, 9th ed., ch. 7: the texts' min(rgb, vec3(1.0)).
// Ranges: radiance not negative; result 0 to 1.
// Edges:  the brightest is exactly 1 (H-X1).

/// What is written of a radiance.
vec3 withinRange(vec3 radiance) { return min(radiance, vec3(1.0)); }  // H-X1
