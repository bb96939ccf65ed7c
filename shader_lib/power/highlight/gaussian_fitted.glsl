// The lobe of a highlight as a spherical Gaussian, a little narrower than its exponent says (S2, S3): off by
// at most 0.13 / m of the peak from m = 4 on, half of what the plain Gaussian is.
//
// Model:  exp(-(m + 0.664) u). With x = m u, (1 - u)^m is exp(-x) (1 - x^2 / 2m) but for 1 / m^2, and
//         exp(-(m + a) u) is exp(-x) (1 - a x / m): the largest |exp(-x) (x^2 / 2 - a x)| is least, 0.126,
//         where its two extremes, at x = 1 + a -+ sqrt(1 + a^2), are equal.
// Source: Wang et al., All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance, SIGGRAPH Asia 2009
//         (the Gaussian of a Blinn lobe); the fit as above.
// Ranges: versine u 0 to 2, exponent m 0 to 1e6; result 0 to 1.
// Edges:  not 1 everywhere at exponent 0 (H-S1), nor 0 from a right angle on (H-S2): exp(-m - 0.664) there.

/// The highlight's share at 1 - cos(angle) = versine.
float highlightPower(float versine, float exponent) { return exp(-(exponent + 0.664) * versine); }
