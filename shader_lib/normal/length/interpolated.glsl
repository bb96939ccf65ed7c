// How long a normal is that was interpolated and is taken as it is (E4).
//
// Model:  |n|.
// Source: OpenGL Programming Guide, 9th ed., ch. 7: an interpolated normal is shorter than 1.
// Range:  0 to 1; below 1e-19 it counts as 0.
// Edges:  0 where the normals cancelled each other (H-N1).

/// The length.
float normalLength(vec3 normal) { return length(normal); }
