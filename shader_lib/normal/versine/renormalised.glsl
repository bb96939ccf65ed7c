// The angle of a highlight between two unit vectors, as a versine (S2, S3).
//
// Model, source, range, edges: versineBetween().
#include "angle/versine.glsl"

/// 1 - cos of the angle between the unit vectors a and b.
float highlightVersine(vec3 a, vec3 b) { return versineBetween(a, b); }
