// The lobe of a highlight as a spherical Gaussian (S2, S3): off by at most 0.28 / m of the peak from m = 4 on.
//
// Model:  exp(m (cos(angle) - 1)) = exp(-m u).
// Source: Wang et al., All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance, SIGGRAPH Asia 2009.
// Ranges: versine u 0 to 2, exponent m 0 to 1e6; result 0 to 1.
// Edges:  1 everywhere at exponent 0 (H-S1); not 0 from a right angle on: exp(-m) there (H-S2).

/// The highlight's share at 1 - cos(angle) = versine.
float highlightPower(float versine, float exponent) { return exp(-exponent * versine); }
