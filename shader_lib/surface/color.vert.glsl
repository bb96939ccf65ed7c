// The surface's colour in the vertex stage (S17).
//
// Model:  C.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Lighting Introduction: the colour as an attribute.
// Range:  0 to 1.
// Edges:  none: the attribute is passed on as it is.

ATTRIBUTE(2) vec4 color;

/// The colour, linear, and its alpha, 0 to 1.
vec4 surfaceColor() { return color; }
