// The coefficients of an environment's light in spherical harmonics (S13).
//
// Model:  the L of the irradiance polynomial, and what its result is scaled by.
// Source: Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH
//         2001. Ten published probes are in gobo/light_probes.hpp.
// Range:  coefficients within 1e5, scale 0 to 1e3; `toProbe` turns and does not stretch.
// Edges:  with a negative lobe the polynomial may be negative: the caller clamps it.

/// Coefficients in the order L00, L1-1, L10, L11, L2-2, L2-1, L20, L21, L22; `toProbe` turns directions from
/// eye space to the probe's axes (the inverse of the view's rotation where these are the world's).
BLOCK(21, Harmonics) {
    mat3 toProbe;
    vec3 coefficients[9];
    float scale;
} harmonics;
