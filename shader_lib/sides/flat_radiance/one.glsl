// The radiance of a face of which one vertex is shaded on one side (E1).
//
// Model:  L of the provoking vertex.
// Source: Bouknight, CACM 13 (1970).
// Range:  as litSurface().
// Edges:  none: nothing is interpolated.

/// The radiance of the face's provoking vertex.
vec3 faceRadiance() { return flatRadiance; }
