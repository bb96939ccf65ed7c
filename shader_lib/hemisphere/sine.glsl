// The share of the sky that a surface sees, exactly (S12).
//
// Model:  a = 1 - 0.5 sin(theta) up to theta = 90 degrees, beyond it 0.5 sin(theta), theta between n and up.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Hemisphere Lighting: the analytic solution.
// Spaces: any, both vectors in the same. Range: unit vectors or zero; result 0 to 1.
// Edges:  sin(theta) = |n x up|, exact near theta = 0 where sqrt(1 - cos^2) is not; both forms meet at 90
//         degrees, so a rounding there decides nothing; a zero vector sees half the sky (H-N1).

/// The share of the sky.
float skyShare(vec3 normal, vec3 up) {
    return 0.5 + 0.5 * sign(dot(normal, up)) * (1.0 - length(cross(normal, up)));
}
