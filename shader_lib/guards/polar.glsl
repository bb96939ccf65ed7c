// A vector as direction and length, for both at the price of one (L4, L5).
//
// Model:  v = |v| (v / |v|).
// Source: the usual scaling of hypot(); Higham, Accuracy and Stability of Numerical Algorithms, 27.8.
// Spaces: any. Range: as vectorScale().
// Edges:  the zero vector has direction zero and length 0 (H-L1); otherwise the direction is unit to 2e-7 at
//         any length (H-N2, H-N3).
#include "guards/full.glsl"

/// The unit vector along v in xyz (zero where v is zero), the length of v in w.
vec4 directionAndLength(vec3 v) {
    float scale = vectorScale(v);
    vec3 scaled = v / scale;  // H-N2, H-N3: no square under- or overflows
    float square = dot(scaled, scaled);
    return vec4(scaled * inversesqrt(max(square, 1e-30)), scale * sqrt(square));  // H-L1: 0 stays 0
}
