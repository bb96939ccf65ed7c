// The lobe of a highlight without a logarithm (S2, S3), for shininess 4 and more: off by 8e-4 at 4, 6e-5 at 8
// and 3e-9 at 100, and as good as the exact power at 1e4 and more, where a plain pow() loses its digits.
//
// Model:  (1 - u)^m with log(1 - u) = -2 artanh(z), z = u / (2 - u), by the first two terms of its series:
//         exp(-2 m z (1 + z^2 / 3)); of q = z / 3, since floats hold no 1/3, exp(-6 m q (1 + 3 q^2)).
// Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.1.27. What is left out is at most
//         2 m z^5 / 5 of the result, hence 0.27 / m^4 of the highlight's peak.
// Ranges: versine u 0 to 2, exponent m 0 to 1e6; result 0 to 1.
// Edges:  0 from a right angle on, except that x^0 is 1 for every x (H-S1, H-S2).

/// The highlight's share at 1 - cos(angle) = versine.
float highlightPower(float versine, float exponent) {
    if (versine >= 1.0) return exponent > 0.0 ? 0.0 : 1.0;  // H-S1, H-S2
    float q = versine / (6.0 - 3.0 * versine);
    return exp(-6.0 * exponent * q * (1.0 + 3.0 * q * q));
}
