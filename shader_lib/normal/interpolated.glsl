// What becomes of a direction that was interpolated between unit vectors: it is taken as it is (E4). Between
// two that are an angle a apart it is as short as cos(a / 2), which darkens what lies between vertices, and a
// highlight of shininess m by as much to the power of m.
//
// Model:  n as it is.
// Source: OpenGL 4 Shading Language Cookbook, ch. 2, and OpenGL Programming Guide, 9th ed., ch. 7, as both
//         warn against.
// Space:  any. Range: lengths 0 to 1; interpolation may pass 1 by a rounding (H-I1).
// Edges:  as short as zero between opposed vectors: then no light from there (H-N1).

/// The direction to shade with.
vec3 shadingDirection(vec3 interpolated) { return interpolated; }
