// How long a normal is that was interpolated and is taken as it is (E4).
//
// Range:  0 to 1; below 1e-19 it counts as 0.

/// The length.
float normalLength(vec3 normal) { return length(normal); }
