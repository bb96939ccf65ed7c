// The radiance of a surface whose vertices are shaded on one side (E2).
//
// Model:  L interpolated between the vertices.
// Source: Gouraud, IEEE Transactions on Computers 20 (1971).
// Range:  as litSurface(), or beyond by a rounding.
// Edges:  the caller clamps what a rounding makes negative (H-I1).

/// The radiance interpolated between the vertices.
vec3 interpolatedRadiance() { return litRadiance; }
