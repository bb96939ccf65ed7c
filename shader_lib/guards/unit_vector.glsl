// The direction of a vector (S3, E4).
//
// Model:  v / |v|.
// Source: the usual scaling of hypot(); Higham, Accuracy and Stability of Numerical Algorithms, 27.8.
// Spaces: any. Range: as vectorScale().
// Edges:  the zero vector stays zero, which every model takes for "no light from there" (H-N1);
//         otherwise the result is unit to 2e-7 at any length (H-N2, H-N3).
#include "guards/full.glsl"

/// The unit vector along v; zero where v is zero.
vec3 unitVector(vec3 v) {
    vec3 scaled = v / vectorScale(v);  // H-N2, H-N3: no square under- or overflows
    return scaled * inversesqrt(max(dot(scaled, scaled), 1e-30));  // H-N1: 0 stays 0
}
