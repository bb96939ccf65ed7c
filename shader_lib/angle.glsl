// Angles between unit vectors as 1 - cos, which keeps small angles apart: a float cosine is 1 for all angles below
// 3.5e-4 radians. A zero vector counts as at a right angle to all: exactly 1. Results 0 to 2.

#piece one_minus_cosine
// 1 - a.b = |a - b|^2 / 2, relative error 2^-23 / angle near 0.
// Source: Sinnott, Virtues of the Haversine, Sky and Telescope 68 (1984); |a - b| as in Lyon, Phong Shading
//         Reformulation for Hardware Renderer Simplification (1993).
/// 1 - cos of the angle between the unit vectors a and b.
float oneMinusCosineBetween(vec3 a, vec3 b) {
    float cosine = dot(a, b);
    vec3 difference = a - b;
    return cosine > 0.5 ? 0.5 * dot(difference, difference) : 1.0 - cosine;  // guard: tiny angle
}

#piece halfway
// 1 - n.h with h = (s + v) / |s + v|; for small angles sin^2 / (1 + sqrt(1 - sin^2)), sin = |n x s + n x v| / |s + v|.
// The half vector is not rounded on the way, nor is s + v, so a highlight of shininess m is true to
// 2 sqrt(m) 2^-24 / |s + v|, as with directions rounded but once; a half vector rounded to a float is off by a third
// more. Opposed directions have no half vector: 1.
// Source: Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977.
#include "guards/full.glsl"

/// 1 - cos of the angle between the unit vector `normal` and the half vector of the unit vectors to the light
/// and to the viewer.
float oneMinusCosineToHalfway(vec3 normal, vec3 toLight, vec3 toViewer) {
    vec3 sum = toLight + toViewer;
    float scale = vectorScale(sum);
    vec3 halfway = sum / scale;
    float square = max(dot(halfway, halfway), 1e-30);  // guard: opposed directions
    float cosine = dot(normal, halfway) * inversesqrt(square);
    if (cosine < 0.8) return 1.0 - cosine;  // guard: sharp highlight
    // Nearly opposed directions have an exact sum.
    vec3 beside = scale > 0.125 ? (cross(normal, toLight) + cross(normal, toViewer)) / scale
                                : cross(normal, halfway);
    float sine = dot(beside, beside) / square;  // squared
    return sine / (1.0 + sqrt(1.0 - sine));
}
