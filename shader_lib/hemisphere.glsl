// The part of the sky that a surface sees, theta being the angle between its normal and up; half of it where there is no
// normal.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Hemisphere Lighting.

#piece sine
// Exact: 1 - 0.5 sin(theta) up to 90 degrees, beyond it 0.5 sin(theta): for a unit normal
// 0.5 + 0.5 sign(n.up) (|n| - |n x up|). |n x up| is exact near theta = 0 where sqrt(1 - cos^2) is not; at 90 degrees both
// forms are 0.5, of a shorter normal too, so a rounding there decides nothing.
#include <normal/length>

/// The part of the sky that is seen, 0 to 1.
float skyWeight(vec3 normal, vec3 up) {
    vec3 across = cross(normal, up);
    float sine = sqrt(dot(across, across));  // guard: unlike length() it may underflow, 0 will do
    return clamp(0.5 + 0.5 * sign(dot(normal, up)) * (normalLength(normal) - sine), 0.0, 1.0);  // guard: rounded out of its range
}

#piece cosine
// 0.5 + 0.5 cos(theta): smooth, cheap, off by up to 0.21, at 45 degrees.
/// The part of the sky that is seen, 0 to 1.
float skyWeight(vec3 normal, vec3 up) { return clamp(0.5 + 0.5 * dot(normal, up), 0.0, 1.0); }  // guard: rounded out of its range
