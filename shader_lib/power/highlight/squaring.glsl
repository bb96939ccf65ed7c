// The lobe of a highlight by repeated squaring (S2, S3): multiplications only, for whole exponents; others
// count as the nearest whole one, which costs up to 0.18 / m of the highlight's peak.
//
// Model:  max(1 - u, 0)^n with n the whole number nearest to m, by the binary digits of n.
// Source: Knuth, The Art of Computer Programming, vol. 2, 4.6.3, Algorithm A.
// Ranges: versine u 0 to 2, exponent m 0 to 1e6 (20 squarings); result 0 to 1.
// Edges:  x^0 is 1 for every x (H-S1); the base is never negative (H-S2); the base's own rounding counts m
//         times, 6e-8 m (H-S3).

/// The highlight's share at 1 - cos(angle) = versine.
float highlightPower(float versine, float exponent) {
    float square = max(1.0 - versine, 0.0);  // H-S2
    float share = 1.0;
    for (int digits = int(roundEven(exponent)); digits > 0; digits >>= 1) {
        if ((digits & 1) == 1) share *= square;
        square *= square;
    }
    return share;
}
