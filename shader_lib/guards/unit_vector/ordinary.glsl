// The direction of a vector of ordinary length (S3, E4).
//
// Model:  v / |v|.
// Source: OpenGL Shading Language 4.50, 8.5: normalize(), which leaves the zero vector undefined.
// Spaces: any. Range: zero, or lengths from 1e-15 to 1e15; their squares are well within a float.
// Edges:  the zero vector stays zero, which every model takes for "no light from there" (H-N1); a vector
//         below the range comes out shorter than 1, one above it is not defined (H-N2 and H-N3 need `full`).

/// The unit vector along v; zero where v is zero.
vec3 unitVector(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }  // H-N1: 0 stays 0
