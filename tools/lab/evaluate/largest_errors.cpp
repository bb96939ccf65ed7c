#include "lab/evaluate/largest_errors.hpp"

#include <cmath>
#include <numbers>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::evaluate {
namespace {

/// The distance from a result to the next float away from 0.
double ulp(double value) {
    const float size = std::fabs(static_cast<float>(value));
    return static_cast<double>(std::nextafter(size, std::numeric_limits<float>::infinity())) -
           static_cast<double>(size);
}

double error_of_exponential(double x, double result) {
    return (3 + 2 * std::fabs(x)) * ulp(result);
}

double error_of_logarithm(double x, double result) {
    return x >= 0.5 && x <= 2 ? 0x1p-21 : 3 * ulp(result);
}

/// An absolute error d of the exponent is a factor of 2^d.
double error_of_power(double x, double y, double result) {
    if (x <= 0) return 0;
    const double logarithm = std::log2(x);
    const double exponent = y * logarithm;
    const double error = std::fabs(y) * error_of_logarithm(x, logarithm) + ulp(exponent) / 2;
    return error * std::numbers::ln2 * result + error_of_exponential(exponent, result);
}

double largest_error(std::uint32_t code, double x, double y, double result) {
    switch (code) {
        case kExtended + GLSLstd450Exp:
        case kExtended + GLSLstd450Exp2:
            return error_of_exponential(x, result);
        case kExtended + GLSLstd450Log:
        case kExtended + GLSLstd450Log2:
            return error_of_logarithm(x, result);
        case kExtended + GLSLstd450Pow:
            return error_of_power(x, y, result);
        case kExtended + GLSLstd450InverseSqrt:
            return 2 * ulp(result);
        default:
            return 0;
    }
}

}  // namespace

bool has_largest_error(std::uint32_t code) {
    switch (code) {
        case kExtended + GLSLstd450Exp:
        case kExtended + GLSLstd450Exp2:
        case kExtended + GLSLstd450Log:
        case kExtended + GLSLstd450Log2:
        case kExtended + GLSLstd450Pow:
        case kExtended + GLSLstd450InverseSqrt:
            return true;
        default:
            return false;
    }
}

template <class T>
void add_largest_error(std::uint32_t code, const Operation& operation, Machine<T>& machine, bool upward) {
    T* result = machine.reals(operation.result);
    const T* x = machine.reals(operation.operands[0]);
    const T* y = code == kExtended + GLSLstd450Pow ? machine.reals(operation.operands[1]) : x;
    for (std::size_t i = 0; i < operation.count * kLanes; ++i) {
        if (!machine.is_active(i % kLanes) || !std::isfinite(result[i])) continue;
        const double error = largest_error(code, static_cast<double>(x[i]), static_cast<double>(y[i]),
                                           static_cast<double>(result[i]));
        const double moved = static_cast<double>(result[i]) + (upward ? error : -error);
        const bool is_logarithm = code == kExtended + GLSLstd450Log || code == kExtended + GLSLstd450Log2;
        // An exponential or a root is never negative, and an error makes no infinity.
        if ((moved >= 0 || is_logarithm) && moved <= static_cast<double>(std::numeric_limits<float>::max()))
            result[i] = static_cast<T>(moved);
    }
}

template void add_largest_error<float>(std::uint32_t, const Operation&, Machine<float>&, bool);
template void add_largest_error<double>(std::uint32_t, const Operation&, Machine<double>&, bool);

}  // namespace gobo::evaluate
