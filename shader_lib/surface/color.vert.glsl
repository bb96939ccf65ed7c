// The surface's colour in the vertex stage (S17).

ATTRIBUTE(2) vec4 color;

/// The colour, linear, and its alpha, 0 to 1.
vec4 surfaceColor() { return color; }
