// Where a ray lies in a spot light's cone: 1 - cos of its angle to the axis, 0 to 2. A zero vector is at a right angle.

#piece one_minus_cosine
// As many digits at an angle of 1e-4 as at a right angle.
#include "angle/one_minus_cosine.glsl"

/// 1 - cos of the angle between the cone's axis and a ray, both unit (zero: a right angle).
float coneOneMinusCosine(vec3 axis, vec3 ray) { return oneMinusCosineBetween(axis, ray); }

#piece angle
// By the angle itself: 2 sin^2(a / 2) with a = atan(|axis x ray|, axis.ray), good to 0.3 % at an angle of 1e-4.
// Source: OpenGL 4 Shading Language Cookbook, ch. 3, Using a Spotlight, which compares acos(axis.ray) with the cutoff; acos
//         has no digits left near 0, the arc tangent of sine and cosine has (Kahan, How Futile are Mindless Assessments
//         of Roundoff in Floating-Point Computation, 2006, 12).
/// 1 - cos of the angle between the cone's axis and a ray, both unit (zero: a right angle).
float coneOneMinusCosine(vec3 axis, vec3 ray) {
    float cosine = dot(axis, ray);
    vec3 normal = cross(axis, ray);
    float sine = sqrt(dot(normal, normal));
    if (sine + abs(cosine) == 0.0) return 1.0;  // guard: atan(0, 0) is undefined
    float halfSine = sin(0.5 * atan(sine, cosine));
    return 2.0 * halfSine * halfSine;
}

#piece cosine
// By the plain cosine: the cheapest, and the rim of a cone below 0.01 radians is coarse, since a float cosine is 1
// for all angles below 3.5e-4 radians. Never negative, so that a cone of 0 holds nothing.
/// 1 - cos of the angle between the cone's axis and a ray, both unit (zero: a right angle).
float coneOneMinusCosine(vec3 axis, vec3 ray) { return max(1.0 - dot(axis, ray), 0.0); }  // guard: cone of 0 or 180 degrees
