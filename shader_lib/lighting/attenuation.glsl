// Attenuation by distance: 1 / (k_c + k_l d + k_q d^2). All coefficients may be 0: the result ends at 1e18. A distance beyond
// 1e17 counts as 1e17, where nothing is left of the light.
//
// Source: OpenGL Programming Guide, 9th ed., ch. 7.

/// The factor by which a light at a distance d is weakened.
float attenuation(vec3 coefficients, float d) {
    float reach = min(d, 1e17);  // guard: the square does not overflow
    float denominator = coefficients.x + reach * (coefficients.y + reach * coefficients.z);
    return 1.0 / max(denominator, 1e-18);  // guard: no attenuation
}
