// The length of a vector (F4).
//
// Model:  |v|.
// Source: the usual scaling of hypot(); Higham, Accuracy and Stability of Numerical Algorithms, 27.8.
// Spaces: any. Range: as vectorScale().
// Edges:  finite wherever the length itself is (H-F2); 0 for the zero vector.
#include "guards/full.glsl"

/// The length of v.
float vectorLength(vec3 v) {
    float scale = vectorScale(v);
    vec3 scaled = v / scale;  // H-F2: no square overflows
    return scale * sqrt(dot(scaled, scaled));
}
