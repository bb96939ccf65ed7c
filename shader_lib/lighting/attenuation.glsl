// How light fades with the distance from a local light (L4).
//
// Model:  1 / (k_c + k_l d + k_q d^2), the coefficients in this order.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights.
// Ranges: coefficients 0 or 1e-6 to 1e3, d 0 to 1e19; result 0 to 1e18.
// Edges:  the denominator is at least 1e-18, so all coefficients may be 0 (H-L2); a distance beyond 1e17
//         counts as 1e17, where the light is long gone (H-L3).

/// The factor by which a light at a distance d is weakened.
float attenuation(vec3 coefficients, float d) {
    float reach = min(d, 1e17);  // H-L3: the square does not overflow
    float denominator = coefficients.x + reach * (coefficients.y + reach * coefficients.z);
    return 1.0 / max(denominator, 1e-18);  // H-L2
}
