// The length of a vector of ordinary length (F4).
//
// Model:  |v|.
// Source: OpenGL Shading Language 4.50, 8.5: length().
// Spaces: any. Range: zero, or lengths from 1e-15 to 1e15; their squares are well within a float.
// Edges:  0 for the zero vector; above 1e19 it overflows (H-F2 needs `full`).

/// The length of v.
float vectorLength(vec3 v) { return sqrt(dot(v, v)); }
