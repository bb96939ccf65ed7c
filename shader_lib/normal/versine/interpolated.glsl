// The angle of a highlight between vectors of which one may be shorter than 1, as the versine that the plain
// dot product stands for (S2, S3): |a - b|^2 / 2 is not the same then.
//
// Model:  1 - a.b.
// Source: OpenGL Programming Guide, 9th ed., ch. 7: the power's base is the dot product itself.
// Range:  vectors of length 0 to 1; result 0 to 2.
// Edges:  never negative, though a length may pass 1 by a rounding (H-I1).

/// 1 - a.b.
float highlightVersine(vec3 a, vec3 b) { return max(1.0 - dot(a, b), 0.0); }  // H-I1
