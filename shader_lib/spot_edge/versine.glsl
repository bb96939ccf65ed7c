// Where a ray lies in a spot light's cone, by the distance between unit vectors (L5): as many digits at an
// angle of 1e-4 as at a right angle.
//
// Model, source, range, edges: versineBetween(); H-P4.
#include "angle/versine.glsl"

/// 1 - cos of the angle between the cone's axis and a ray, both unit (zero: a right angle).
float coneVersine(vec3 axis, vec3 ray) { return versineBetween(axis, ray); }
