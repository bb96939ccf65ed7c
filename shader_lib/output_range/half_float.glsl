// Radiance that a target of 16-bit floats can hold (L7).
//
// Model:  min(L, 65504).
// Source: IEEE 754-2019, 3.6: the largest finite binary16 is (2 - 2^-10) 2^15; from 65520 on a conversion
//         rounds to infinity.
// Ranges: radiance not negative; result 0 to 65504.
// Edges:  what the target cannot hold is the brightest that it can, not infinity (H-X1).

/// What is written of a radiance.
vec3 withinRange(vec3 radiance) { return min(radiance, vec3(65504.0)); }  // H-X1
