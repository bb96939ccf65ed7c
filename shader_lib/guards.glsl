// Lengths and directions of vectors. With `full` of any vector: it is scaled by its largest component, so that no
// square leaves the range of a float. With `ordinary` of vectors from 1e-15 to 1e15: a shorter one comes out shorter
// than 1, one above 1e19 overflows. The zero vector has length 0 and direction 0: no light comes from there.
//
// Source: the usual scaling of hypot(); Higham, Accuracy and Stability of Numerical Algorithms, 27.8; OpenGL Shading
//         Language 4.50, 8.5, whose normalize() leaves the zero vector undefined.

#piece full
/// A positive number: v / vectorScale(v) has a largest component of 1, or is zero where v is zero.
float vectorScale(vec3 v) {
    vec3 size = abs(v);
    float largest = max(size.x, max(size.y, size.z));
    return max(largest, 1e-37);  // guard: the zero vector
}

#piece unit_vector
// Unit to 2e-7 at lengths from 1e-37 to 1e38.
#include "guards/full.glsl"

/// The unit vector along v; zero where v is zero.
vec3 unitVector(vec3 v) {
    vec3 scaled = v / vectorScale(v);  // guard: no square under- or overflows
    return scaled * inversesqrt(max(dot(scaled, scaled), 1e-30));  // guard: 0 stays 0
}

#piece unit_vector/ordinary
/// The unit vector along v; zero where v is zero.
vec3 unitVector(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }  // guard: 0 stays 0

#piece vector_length
#include "guards/full.glsl"

/// The length of v.
float vectorLength(vec3 v) {
    float scale = vectorScale(v);
    vec3 scaled = v / scale;  // guard: no square overflows
    return scale * sqrt(dot(scaled, scaled));
}

#piece vector_length/ordinary
/// The length of v.
float vectorLength(vec3 v) { return sqrt(dot(v, v)); }

#piece polar
#include "guards/full.glsl"

/// The unit vector along v in xyz (zero where v is zero), the length of v in w.
vec4 directionAndLength(vec3 v) {
    float scale = vectorScale(v);
    vec3 scaled = v / scale;  // guard: no square under- or overflows
    float square = dot(scaled, scaled);
    return vec4(scaled * inversesqrt(max(square, 1e-30)), scale * sqrt(square));  // guard: 0 stays 0
}

#piece polar/ordinary
/// The unit vector along v in xyz (zero where v is zero), the length of v in w.
vec4 directionAndLength(vec3 v) {
    float square = dot(v, v);
    return vec4(v * inversesqrt(max(square, 1e-30)), sqrt(square));  // guard: 0 stays 0
}
