// Scattered light adds up without bound: what Lambert's law and bands share (S1, S7).

/// Prepares the sum of a point's scattered light: nothing.
void beginDiffuse() {}

/// The scattered light that remains of the sum of all terms: all of it.
vec3 limitedDiffuse(vec3 total) { return total; }
