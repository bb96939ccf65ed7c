// The lobe of a highlight by Lyon's reformulation (S2, S3): no exponential, three multiplications; off by up
// to 0.074 of the peak, and nothing is left of the lobe beyond u = 4 / m.
//
// Model:  max(1 - m u / 4, 0)^4 with u = |a - b|^2 / 2: Lyon's (1 - beta D)^gamma for gamma = 4.
// Source: Lyon, Phong Shading Reformulation for Hardware Renderer Simplification, Apple Technical Report 43
//         (1993).
// Ranges: versine u 0 to 2, exponent m 0 to 1e6; result 0 to 1.
// Edges:  1 everywhere at exponent 0 (H-S1); below exponent 4 not 0 from a right angle on (H-S2).

/// The highlight's share at 1 - cos(angle) = versine.
float highlightPower(float versine, float exponent) {
    float root = max(1.0 - 0.25 * exponent * versine, 0.0);  // H-S2
    float square = root * root;
    return square * square;
}
