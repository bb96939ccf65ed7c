// The lobe of a highlight by Schlick's rational function (S2, S3): one division; off by up to 0.2 of the peak,
// with a tail that is much too long.
//
// Model:  c / (m - m c + c), c = max(1 - u, 0), so that m - m c = m u.
// Source: Schlick, A Fast Alternative to Phong's Specular Model, Graphics Gems IV (1994), VI.1.
// Ranges: versine u 0 to 2, exponent m 0 to 1e6; result 0 to 1.
// Edges:  0 from a right angle on, except that x^0 is 1 for every x (H-S1, H-S2); the denominator is never 0.

/// The highlight's share at 1 - cos(angle) = versine.
float highlightPower(float versine, float exponent) {
    if (versine >= 1.0) return exponent > 0.0 ? 0.0 : 1.0;  // H-S1, H-S2
    float cosine = 1.0 - versine;
    return cosine / (exponent * versine + cosine);
}
