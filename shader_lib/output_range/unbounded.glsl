// Radiance as it is, for a target of 32-bit floats (L7).
//
// Model:  L.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights: without the texts' min(), which is a
//         choice of the display.
// Range:  radiance not negative.
// Edges:  none: an infinite radiance stays infinite.

/// What is written of a radiance.
vec3 withinRange(vec3 radiance) { return radiance; }
