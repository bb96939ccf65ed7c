// The surface's colour in the fragment stage: interpolated between vertices (S17).
//
// Model:  C.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Lighting Introduction: the colour as an attribute.
// Range:  0 to 1, or above by a rounding.
// Edges:  interpolation may leave its range by a rounding; a colour is not negative (H-I1).

/// The colour, linear, and its alpha, 0 to 1.
vec4 surfaceColor() { return max(vertexColor, vec4(0.0)); }  // H-I1
