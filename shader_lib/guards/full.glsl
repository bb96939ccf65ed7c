// The scale of a vector: the guard that lets lengths and directions be taken of any vector (L4, L5, E4, F4).
//
// Model:  |v| = m |v / m| with m = max(|x|, |y|, |z|), so that no square leaves the range of a float.
// Source: the usual scaling of hypot(); Higham, Accuracy and Stability of Numerical Algorithms, 27.8.
// Spaces: any. Range: lengths from 1e-37 to 1e38.
// Edges:  the zero vector has a positive scale too, so v / vectorScale(v) is always defined.

/// A positive number: v / vectorScale(v) has a largest component of 1, or is zero where v is zero.
float vectorScale(vec3 v) {
    vec3 size = abs(v);
    float largest = max(size.x, max(size.y, size.z));
    return max(largest, 1e-37);  // H-N1: the zero vector
}
