// Directions interpolated between unit vectors: whether they are made unit again, and angles to them.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7: an interpolated normal is shorter than 1, and the power's base is the
//         dot product itself.
// Edges:  where the vectors cancel each other it is zero: no light from there. Interpolation may pass 1 by a rounding.

#piece renormalised
// Made unit again.
#include <guards/unit_vector>

/// The direction to shade with.
vec3 shadingDirection(vec3 interpolated) { return unitVector(interpolated); }

#piece interpolated
// Taken as it is. Between two that are an angle a apart it is as short as cos(a / 2), which darkens what lies between
// vertices, and a highlight of shininess m by as much to the power of m.
/// The direction to shade with.
vec3 shadingDirection(vec3 interpolated) { return interpolated; }

#piece length/renormalised
// A zero normal counts as unit.
/// The length: 1.
float normalLength(vec3 normal) { return 1.0; }

#piece length/interpolated
/// The length.
float normalLength(vec3 normal) { return length(normal); }

#piece one_minus_cosine/renormalised
#include "angle/one_minus_cosine.glsl"

/// 1 - cos of the angle between the unit vectors a and b.
float highlightOneMinusCosine(vec3 a, vec3 b) { return oneMinusCosineBetween(a, b); }

#piece one_minus_cosine/interpolated
// |a - b|^2 / 2 is not the same where one is shorter than 1.
/// 1 - a.b.
float highlightOneMinusCosine(vec3 a, vec3 b) { return max(1.0 - dot(a, b), 0.0); }  // guard: rounded out of its range

#piece halfway_one_minus_cosine/renormalised
#include "angle/halfway.glsl"

/// 1 - cos of the angle between `normal` and the half vector of the directions to the light and the viewer.
float halfwayOneMinusCosine(vec3 normal, vec3 toLight, vec3 toViewer) {
    return oneMinusCosineToHalfway(normal, toLight, toViewer);
}

#piece halfway_one_minus_cosine/interpolated
#include <guards/unit_vector>
#include <normal/one_minus_cosine>

/// 1 - n.h of the half vector of the directions to the light and the viewer.
float halfwayOneMinusCosine(vec3 normal, vec3 toLight, vec3 toViewer) {
    return highlightOneMinusCosine(normal, unitVector(toLight + toViewer));
}
