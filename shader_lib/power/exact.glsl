// max(c, 0)^m with c = 1 - u: the lobe of a highlight and of a spot light, as exp(m log(1 - u)). Below u = 3/16
// log(1 - u) = -2 artanh(z), z = u / (2 - u), by its series to z^7: 2e-7 relative to u, where the rounding of c alone costs
// a plain pow(c, m) up to m 2^-24.
//
// Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.1.27.
// Ranges: u 0 to 2, exponent 0 to 1e6; result 0 to 1.
// Edges:  x^0 is 1 for every x, 0^0 too; the base is never negative nor above 1; at a large exponent what remains is the
//         rounding of the directions, about 2 sqrt(m) 2^-24 / |l + v|.

/// log(1 - oneMinusCosine), for 0 to 1.
float logarithmOfCosine(float oneMinusCosine) {
    if (oneMinusCosine > 0.1875) return log(1.0 - oneMinusCosine);
    float z = oneMinusCosine / (2.0 - oneMinusCosine);
    float square = z * z;
    return -2.0 * z * (1.0 + square * (1.0 / 3.0 + square * (0.2 + square * (1.0 / 7.0))));  // guard: sharp highlight
}

/// max(1 - oneMinusCosine, 0) to the power of `exponent`.
float cosinePower(float oneMinusCosine, float exponent) {
    if (oneMinusCosine < 1.0) return exp(exponent * logarithmOfCosine(oneMinusCosine));  // guard: base below 0 or behind the light
    return exponent > 0.0 ? 0.0 : 1.0;  // guard: 0 to the power of 0
}
