// The angle between a normal and the half vector of two directions, as its versine (S3).
//
// Model:  1 - n.h with h = (s + v) / |s + v|; for small angles sin^2 / (1 + sqrt(1 - sin^2)), with
//         sin = |n x s + n x v| / |s + v|. The half vector is not rounded on the way, nor is the sum s + v.
// Source: Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977; the identity
//         |a x b| = sin, and 1 - cos = sin^2 / (1 + cos).
// Spaces: any, all in the same. Ranges: unit vectors or zero; result 0 to 2.
// Edges:  exactly 1, a right angle, for opposed directions (H-N4) and for a zero normal (H-N1). A highlight of
//         shininess m is true to 2 sqrt(m) 2^-24 / |s + v| (H-S3), as with directions rounded but once; with
//         a half vector rounded to a float it is off by a third more.
#include "guards/full.glsl"

/// 1 - cos of the angle between the unit vector `normal` and the half vector of the unit vectors to the light
/// and to the viewer.
float versineToHalfway(vec3 normal, vec3 toLight, vec3 toViewer) {
    vec3 sum = toLight + toViewer;
    float scale = vectorScale(sum);
    vec3 halfway = sum / scale;
    float square = max(dot(halfway, halfway), 1e-30);  // H-N4
    float cosine = dot(normal, halfway) * inversesqrt(square);
    if (cosine < 0.8) return 1.0 - cosine;  // H-S3
    // Nearly opposed directions have an exact sum.
    vec3 beside = scale > 0.125 ? (cross(normal, toLight) + cross(normal, toViewer)) / scale
                                : cross(normal, halfway);
    float sine = dot(beside, beside) / square;  // squared
    return sine / (1.0 + sqrt(1.0 - sine));
}
