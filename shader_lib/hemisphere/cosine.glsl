// The share of the sky that a surface sees, by the cosine (S12): smooth, cheap, off by up to 0.21, at 45 degrees.
//
// Model:  a = 0.5 + 0.5 cos(theta), theta between n and up.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Hemisphere Lighting.
// Spaces: any, both vectors in the same. Range: unit vectors or zero; result 0 to 1.
// Edges:  a rounding outside [0, 1] is clamped; a zero vector sees half the sky (H-N1).

/// The share of the sky.
float skyShare(vec3 normal, vec3 up) { return clamp(0.5 + 0.5 * dot(normal, up), 0.0, 1.0); }  // H-I1
