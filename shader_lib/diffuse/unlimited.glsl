// Scattered light adds up without bound: what Lambert's law and bands share (S1, S7).
//
// Model:  sum of t_i.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials.
// Range:  terms not negative; result linear and unclamped.
// Edges:  none: the sum is passed on as it is.

/// Prepares the sum of a point's scattered light: nothing.
void beginDiffuse() {}

/// The scattered light that remains of the sum of all terms: all of it.
vec3 limitedDiffuse(vec3 total) { return total; }
