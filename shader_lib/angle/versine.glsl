// The angle between two directions as its versine (S2, S3, L5), 1 - cos(angle), which keeps small angles apart: a float
// cosine tells none below 3.5e-4 radians from 0.
//
// Model:  1 - a.b = |a - b|^2 / 2 for unit vectors.
// Source: Sinnott, Virtues of the Haversine, Sky and Telescope 68 (1984); |a - b| as in Lyon, Phong Shading
//         Reformulation for Hardware Renderer Simplification (1993).
// Spaces: any, both vectors in the same. Range: unit vectors or zero; result 0 to 2.
// Edges:  relative error 2^-23 / angle near 0; never negative; exactly 1 (a right angle) for a zero vector,
//         as the dot product has it (H-N1, H-N4).

/// 1 - cos of the angle between the unit vectors a and b.
float versineBetween(vec3 a, vec3 b) {
    float cosine = dot(a, b);
    vec3 difference = a - b;
    return cosine > 0.5 ? 0.5 * dot(difference, difference) : 1.0 - cosine;  // H-P4
}
