// The share of the sky that a surface sees, exactly (S12).
//
// Model:  a = 1 - 0.5 sin(theta) up to theta = 90 degrees, beyond it 0.5 sin(theta), theta between n and up: both are
//         0.5 + 0.5 sign(n.up) (|n| - |n x up|) for a unit normal.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Hemisphere Lighting: the analytic solution.
// Spaces: any, both vectors in the same. Range: lengths 0 to 1; result 0 to 1.
// Edges:  sin(theta) = |n x up|, exact near theta = 0 where sqrt(1 - cos^2) is not; at 90 degrees both forms are 0.5,
//         of a shorter normal too, so a rounding there decides nothing; a zero vector sees half the sky (H-N1); a normal
//         that a rounding left longer than 1 sees no less than nothing.
#include <normal/length>

/// The share of the sky.
float skyShare(vec3 normal, vec3 up) {
    vec3 across = cross(normal, up);
    float sine = sqrt(dot(across, across));  // H-N2: unlike length() it may underflow, 0 will do
    return clamp(0.5 + 0.5 * sign(dot(normal, up)) * (normalLength(normal) - sine), 0.0, 1.0);  // H-I1
}
