// The lobe of a highlight: the power of a cosine (S2, S3).
//
// Model, source, ranges, edges: cosinePower().
#include "power/exact.glsl"

/// The highlight's share at 1 - cos(angle) = versine.
float highlightPower(float versine, float exponent) { return cosinePower(versine, exponent); }
