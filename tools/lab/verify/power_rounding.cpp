#include "lab/verify/power_rounding.hpp"

#include <algorithm>
#include <cmath>

#include "lab/oracle/response.hpp"
#include "lab/verify/rounding.hpp"

namespace gobo::verify {
namespace {

using oracle::Power;

constexpr double kU = kUnitRoundoff;

/// Results below this may be flushed to 0.
constexpr double kSmallestFloat = 0x1p-126;

/// What computing 1 - u costs: nothing where a formula takes u as it is; otherwise one rounding of 1.
double subtraction_error(Power power, const OneMinusCosine& u) {
    switch (power) {
        case Power::exact:
        case Power::near_exact:
            return u.value < 0.1 ? 0 : kU;
        case Power::squaring:
        case Power::schlick:
            return kU;
        default:
            return 0;
    }
}

/// The roundings of the formula, each counted as often as what follows multiplies it by.
double formula_error(Power power, const OneMinusCosine& u, double exponent, double value) {
    const double logarithm = value > 0 ? std::abs(std::log(value)) : 0;
    switch (power) {
        case Power::exact:  // six of the logarithm and the product, two of the exponential
            return value * (6 * logarithm + 2) * kU;
        case Power::near_exact:  // z, its square and the products: nine; two of the exponential
            return value * (9 * logarithm + 2) * kU;
        case Power::squaring: {
            // The square's error doubles and gets a rounding: n in all for the factors of c^n together, and
            // one for each of at most 20 products. Squares that underflow are lost products of the result.
            const double whole = std::nearbyint(exponent);
            return value * (whole + 20) * kU + kSmallestFloat;
        }
        case Power::gaussian_fitted:  // the sum, the product; two of the exponential
        case Power::gaussian:
            return value * (2 * logarithm + 2) * kU + kSmallestFloat;
        case Power::lyon: {
            // 1 - x, where x = m u / 4 has two roundings and the difference one of at most 1; the fourth
            // power multiplies it by 4 b^3 and adds two products.
            const double x = exponent * u.value / 4;
            const double root = std::max(1 - x, 0.0);
            const double off = 2 * kU * std::min(x, 1.0) + kU;
            return 4 * std::pow(root + off, 3) * off + 2 * value * kU;
        }
        case Power::schlick:  // a product, a sum of terms that are not negative, a division
            return value * 3 * kU;
    }
    return 0;
}

}  // namespace

double power_error(Power power, const OneMinusCosine& one_minus_cosine, double exponent) {
    const double spread = one_minus_cosine.error + subtraction_error(power, one_minus_cosine);
    const double least = oracle::lobe(power, std::min(one_minus_cosine.value + spread, 2.0), exponent);
    const double most = oracle::lobe(power, std::max(one_minus_cosine.value - spread, 0.0), exponent);
    const double value = oracle::lobe(power, one_minus_cosine.value, exponent);
    return most - least + formula_error(power, one_minus_cosine, exponent, value);
}

}  // namespace gobo::verify
