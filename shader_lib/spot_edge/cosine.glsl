// Where a ray lies in a spot light's cone, by the plain cosine (L5): the cheapest, and the rim of a narrow cone
// is coarse, since floats near 1 tell no angle below 3.5e-4 radians from 0.
//
// Model:  1 - axis.ray.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Spotlights.
// Space:  any. Range: unit vectors or zero; result 0 to 2.
// Edges:  a zero vector is at a right angle; never negative, so that a cone of 0 holds nothing (H-P2); cones
//         below 0.01 radians need the versine (H-P4).

/// 1 - cos of the angle between the cone's axis and a ray, both unit (zero: a right angle).
float coneVersine(vec3 axis, vec3 ray) { return max(1.0 - dot(axis, ray), 0.0); }  // H-P2
