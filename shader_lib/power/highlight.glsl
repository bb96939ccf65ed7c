// The lobe of a highlight at u = 1 - cos(angle) of 0 to 2, with an exponent m of 0 to 1e6; result 0 to 1. Errors are of
// the highlight's peak.

#piece exact
#include "power/exact.glsl"

/// The highlight's weight at an angle.
float highlightPower(float oneMinusCosine, float exponent) { return cosinePower(oneMinusCosine, exponent); }

#piece near_exact
// Without a logarithm, for exponents from 4 on: off by 8e-4 at 4, 6e-5 at 8 and 3e-9 at 100, and as good as the exact power
// at 1e4 and more, where a plain pow() loses its digits. log(1 - u) = -2 artanh(z), z = u / (2 - u), by the first two terms
// of its series: exp(-2 m z (1 + z^2 / 3)); of q = z / 3, since floats hold no 1/3, exp(-6 m q (1 + 3 q^2)). What is left
// out is at most 2 m z^5 / 5 of the result, hence 0.27 / m^4.
/// The highlight's weight at an angle.
float highlightPower(float oneMinusCosine, float exponent) {
    if (oneMinusCosine >= 1.0) return exponent > 0.0 ? 0.0 : 1.0;  // guard: 0 to the power of 0 or base below 0
    float q = oneMinusCosine / (6.0 - 3.0 * oneMinusCosine);
    return exp(-6.0 * exponent * q * (1.0 + 3.0 * q * q));
}

#piece squaring
// By the binary digits of the whole number nearest to m, which costs up to 0.18 / m. The base's rounding counts m times.
// Source: Knuth, The Art of Computer Programming, vol. 2, 4.6.3, Algorithm A.
/// The highlight's weight at an angle.
float highlightPower(float oneMinusCosine, float exponent) {
    float square = max(1.0 - oneMinusCosine, 0.0);  // guard: base below 0
    float weight = 1.0;
    int digits = int(roundEven(exponent));
    // The bound is for Mesa 25.0, which crashes when it links a loop without one to a vertex stage.
    for (int i = 0; i < 31 && digits > 0; ++i) {
        if ((digits & 1) == 1) weight *= square;
        square *= square;
        digits >>= 1;
    }
    return weight;
}

#piece gaussian_fitted
// A spherical Gaussian a little narrower than its exponent says: off by at most 0.13 / m from m = 4 on. With x = m u,
// (1 - u)^m is exp(-x) (1 - x^2 / 2m) but for 1 / m^2, and exp(-(m + a) u) is exp(-x) (1 - a x / m): the largest
// |exp(-x) (x^2 / 2 - a x)| is least, 0.126, where its two extremes, at x = 1 + a -+ sqrt(1 + a^2), are equal.
// Not 1 everywhere at exponent 0, nor 0 from a right angle on: exp(-m - 0.664) there.
/// The highlight's weight at an angle.
float highlightPower(float oneMinusCosine, float exponent) { return exp(-(exponent + 0.664) * oneMinusCosine); }

#piece gaussian
// A spherical Gaussian: off by at most 0.28 / m from m = 4 on. Not 0 from a right angle on: exp(-m) there.
// Source: Wang et al., All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance, SIGGRAPH Asia 2009.
/// The highlight's weight at an angle.
float highlightPower(float oneMinusCosine, float exponent) { return exp(-exponent * oneMinusCosine); }

#piece lyon
// max(1 - m u / 4, 0)^4, three multiplications: off by up to 0.074, and nothing is left of the lobe beyond u = 4 / m. Below
// exponent 4 not 0 from a right angle on.
// Source: Lyon, Phong Shading Reformulation for Hardware Renderer Simplification, Apple Technical Report 43 (1993).
/// The highlight's weight at an angle.
float highlightPower(float oneMinusCosine, float exponent) {
    float root = max(1.0 - 0.25 * exponent * oneMinusCosine, 0.0);  // guard: base below 0
    float square = root * root;
    return square * square;
}

#piece schlick
// c / (m - m c + c), one division: off by up to 0.2, with a tail that is much too long. m - m c = m u.
// Source: Schlick, A Fast Alternative to Phong's Specular Model, Graphics Gems IV (1994), VI.1.
/// The highlight's weight at an angle.
float highlightPower(float oneMinusCosine, float exponent) {
    if (oneMinusCosine >= 1.0) return exponent > 0.0 ? 0.0 : 1.0;  // guard: 0 to the power of 0 or base below 0
    float cosine = 1.0 - oneMinusCosine;
    return cosine / (exponent * oneMinusCosine + cosine);
}
