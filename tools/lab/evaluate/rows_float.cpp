// Arithmetic and functions of floats, component by component, and conversions of them. GLSL.std.450 gives the
// formulas where they are more than one operation.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "lab/evaluate/half.hpp"
#include "lab/evaluate/rows.hpp"

namespace gobo::evaluate {
namespace {

/// The components of a vector or matrix times one float.
constexpr auto kScale = []<class T>(const Operation& operation, Registers<T>& registers) {
    const T* b = registers.floats(operation.operands[1]);
    for_each_component<Floats>(operation, registers, [&](T* __restrict result, const T* a, const T* /*b*/) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) result[lane] = a[lane] * b[lane];
    });
};

/// x to the y. What GLSL leaves undefined (x < 0, or x = 0 with y <= 0) is NaN here, so that it shows.
constexpr auto kPower = []<class T>(T x, T y) {
    if (x < 0 || (x == 0 && y <= 0)) return std::numeric_limits<T>::quiet_NaN();
    return std::pow(x, y);
};

constexpr auto kSmoothStep = []<class T>(T edge0, T edge1, T x) {
    const T ratio = (x - edge0) / (edge1 - edge0);
    const T t = ratio < 0 ? T(0) : ratio > 1 ? T(1) : ratio;
    return t * t * (T(3) - T(2) * t);
};

// The variants of min and max that prefer what is no NaN.
constexpr auto kNumberMin = [](auto x, auto y) { return std::isnan(x) ? y : kMin(x, y); };
constexpr auto kNumberMax = [](auto x, auto y) { return std::isnan(x) ? y : kMax(x, y); };
// Those that give a NaN, whichever operand it is.
constexpr auto kNaNMin = [](auto x, auto y) { return std::isnan(y) ? y : kMin(x, y); };
constexpr auto kNaNMax = [](auto x, auto y) { return std::isnan(y) ? y : kMax(x, y); };

template <auto Min, auto Max>
constexpr Execution kClamp = kFloats<[](auto x, auto low, auto high) { return Min(Max(x, low), high); }>;

// Two results: the fractional and the whole part, or the significand and the exponent.
constexpr auto kModf = [](const Operation& operation, auto& registers) {
    auto* result = registers.floats(operation.result);
    const auto* x = registers.floats(operation.operands[0]);
    auto* whole = registers.floats(operation.result + operation.count);
    for (std::size_t i = 0; i < operation.count * kLanes; ++i) result[i] = std::modf(x[i], whole + i);
};
constexpr auto kFrexp = [](const Operation& operation, auto& registers) {
    auto* result = registers.floats(operation.result);
    const auto* x = registers.floats(operation.operands[0]);
    auto* exponents = registers.ints(operation.result + operation.count);
    for (std::size_t i = 0; i < operation.count * kLanes; ++i) {
        int exponent = 0;
        result[i] = std::frexp(x[i], &exponent);
        exponents[i] = exponent;
    }
};

/// Truncated; what does not fit becomes the nearest that does, NaN becomes 0 (GLSL leaves both undefined).
template <class Integer>
constexpr auto kSaturate = [](auto value) {
    constexpr double kLow = std::numeric_limits<Integer>::min();
    constexpr double kHigh = std::numeric_limits<Integer>::max();
    const auto wide = static_cast<double>(value);
    return std::isnan(wide) ? 0 : to_signed(static_cast<Integer>(std::clamp(wide, kLow, kHigh)));
};

// Floats have the bits of the nearest fp32 value, in either arithmetic.
constexpr auto kBitsOf = [](auto value) { return std::bit_cast<std::int32_t>(static_cast<float>(value)); };
constexpr auto kFloatOf = [](auto bits) { return std::bit_cast<float>(to_signed(bits)); };
constexpr auto kBitsOfHalf = [](auto value) { return to_signed(Half::pack(static_cast<double>(value))); };
constexpr auto kHalfOf = [](auto bits) { return Half::unpack(to_unsigned(bits)); };
constexpr auto kSame = [](auto a) { return a; };

// The largest errors allowed, by Vulkan 1.3, Precision of Individual Operations, which OpenGL's drivers
// follow (GLSL 4.50, 4.7.1, leaves them open): exp2 3 + 2 |x| ulp, log2 3 ulp, within [0.5, 2] an absolute
// 2^-21, inversesqrt 2 ulp, division 2.5 ulp, sin and cos an absolute 2^-11 within [-pi, pi], atan
// 4096 ulp; the others what they are inherited from adds up to: pow exp2(y log2(x)), sqrt 1 / inversesqrt(x).

double error_of_exponential(double x, double /*y*/, double result) {
    return (3 + 2 * std::fabs(x)) * ulp(result);
}
double error_of_logarithm(double x, double /*y*/, double result) {
    return x >= 0.5 && x <= 2 ? 0x1p-21 : 3 * ulp(result);
}
/// An absolute error d of the exponent is a factor of 2^d.
double error_of_power(double x, double y, double result) {
    if (x <= 0) return 0;
    const double logarithm = std::log2(x);
    const double exponent = y * logarithm;
    const double error = std::fabs(y) * error_of_logarithm(x, 0, logarithm) + ulp(exponent) / 2;
    return error * std::numbers::ln2 * result + error_of_exponential(exponent, 0, result);
}
double error_of_inverse_root(double /*x*/, double /*y*/, double result) {
    return 2 * ulp(result);
}
double error_of_division(double /*x*/, double divisor, double result) {
    const double size = std::fabs(divisor);
    return result != 0 && size >= 0x1p-126 && size <= 0x1p126 ? 2.5 * ulp(result) : 0;
}
/// As 1 / inversesqrt(x).
double error_of_root(double /*x*/, double /*y*/, double result) {
    return result > 0 ? 4.5 * ulp(result) : 0;
}
double error_of_sine(double x, double /*y*/, double /*result*/) {
    return std::fabs(x) <= std::numbers::pi ? 0x1p-11 : 0;
}
/// As sin(x) / cos(x).
double error_of_tangent(double x, double /*y*/, double result) {
    const double secant = std::sqrt(1 + result * result);
    return error_of_sine(x, 0, 0) * (1 + std::fabs(result)) * secant;
}
double error_of_arc_tangent(double /*y*/, double /*x*/, double result) {
    return 4096 * ulp(result);
}
/// As atan() of x and sqrt(1 - x * x), whose rounding counts most beside the ends.
double error_of_arc_sine(double x, double /*y*/, double result) {
    const double cosine = std::sqrt(std::max(1 - x * x, 0x1p-24));
    return 4096 * ulp(result) + 0x1p-24 / cosine;
}
/// As sums of exp(x) and exp(-x).
double error_of_hyperbolic(double x, double /*y*/, double result) {
    return (3 + 2 * std::fabs(x)) * ulp(result);
}
constexpr Liberties kExponential{.largest_error = error_of_exponential};
constexpr Liberties kLogarithm{.largest_error = error_of_logarithm};
constexpr Liberties kDivision{.largest_error = error_of_division};
constexpr Liberties kSine{.largest_error = error_of_sine};
constexpr Liberties kArcSine{.largest_error = error_of_arc_sine};
constexpr Liberties kArcTangent{.largest_error = error_of_arc_tangent};
constexpr Liberties kHyperbolic{.largest_error = error_of_hyperbolic};
constexpr Liberties kInverseRoot{.largest_error = error_of_inverse_root};
constexpr Liberties kMinOfNaN{.nan_kept = kFloats<kNaNMin>, .nan_dropped = kFloats<kNumberMin>};
constexpr Liberties kMaxOfNaN{.nan_kept = kFloats<kNaNMax>, .nan_dropped = kFloats<kNumberMax>};
constexpr Liberties kClampOfNaN{.nan_kept = kClamp<kNaNMin, kNaNMax>,
                                .nan_dropped = kClamp<kNumberMin, kNumberMax>};
constexpr auto kMix = [](auto x, auto y, auto a) { return x * (1 - a) + y * a; };
constexpr auto kFusedMix = [](auto x, auto y, auto a) { return std::fma(x, 1 - a, y * a); };
constexpr auto kLoadExponent = [](auto x, auto e) { return std::ldexp(x, to_signed(e)); };
template <class T>
constexpr T kRadian = std::numbers::pi_v<T> / 180;
template <class T>
constexpr T kDegree = 180 / std::numbers::pi_v<T>;

constexpr Row kRows[] = {
    {GOBO_CORE(FNegate), Kind::add, "f:f", kFloats<[](auto a) { return -a; }>},
    {GOBO_CORE(FAdd), Kind::add, "f:ff", kFloats<[](auto a, auto b) { return a + b; }>},
    {GOBO_CORE(FSub), Kind::add, "f:ff", kFloats<[](auto a, auto b) { return a - b; }>},
    {GOBO_CORE(FMul), Kind::mul, "f:ff", kFloats<[](auto a, auto b) { return a * b; }>},
    {GOBO_CORE(FDiv), Kind::div, "f:ff", kFloats<[](auto a, auto b) { return a / b; }>, kDivision},
    {GOBO_CORE(FRem), Kind::div, "f:ff", kFloats<[](auto a, auto b) { return std::fmod(a, b); }>},
    {GOBO_CORE(FMod), Kind::div, "f:ff", kFloats<[](auto a, auto b) { return a - b * std::floor(a / b); }>},
    {GOBO_CORE(VectorTimesScalar), Kind::mul, "f:fF", kRun<kScale>},
    {GOBO_CORE(MatrixTimesScalar), Kind::mul, "m:mF", kRun<kScale>},
    {GOBO_CORE(ConvertFToS), Kind::convert, "i:f", kTest<kSaturate<std::int32_t>>},
    {GOBO_CORE(ConvertFToU), Kind::convert, "i:f", kTest<kSaturate<std::uint32_t>>},
    {GOBO_CORE(ConvertSToF), Kind::convert, "f:i", kMap<[](auto a) { return to_signed(a); }, Floats, Ints>},
    {GOBO_CORE(ConvertUToF), Kind::convert, "f:i", kMap<[](auto a) { return to_unsigned(a); }, Floats, Ints>},
    {GOBO_CORE(Bitcast), Kind::convert, "i:h", kTest<kBitsOfHalf>},
    {GOBO_CORE(Bitcast), Kind::convert, "h:i", kMap<kHalfOf, Floats, Ints>},
    {GOBO_CORE(Bitcast), Kind::convert, "i:f", kTest<kBitsOf>},
    {GOBO_CORE(Bitcast), Kind::convert, "f:i", kMap<kFloatOf, Floats, Ints>},
    {GOBO_CORE(Bitcast), Kind::convert, "i:i", kInts<kSame>},
    {GOBO_CORE(UConvert), Kind::convert, "i:i", kInts<kSame>},
    {GOBO_CORE(SConvert), Kind::convert, "i:i", kInts<kSame>},
    {GOBO_EXTENDED(Round), Kind::round, "f:f", kFloats<[](auto x) { return std::round(x); }>},
    {GOBO_EXTENDED(RoundEven), Kind::round, "f:f", kFloats<[](auto x) { return std::nearbyint(x); }>},
    {GOBO_EXTENDED(Trunc), Kind::round, "f:f", kFloats<[](auto x) { return std::trunc(x); }>},
    {GOBO_EXTENDED(Floor), Kind::round, "f:f", kFloats<[](auto x) { return std::floor(x); }>},
    {GOBO_EXTENDED(Ceil), Kind::round, "f:f", kFloats<[](auto x) { return std::ceil(x); }>},
    {GOBO_EXTENDED(Fract), Kind::round, "f:f", kFloats<[](auto x) { return x - std::floor(x); }>},
    {GOBO_EXTENDED(FAbs), Kind::min_max, "f:f", kFloats<[](auto x) { return std::fabs(x); }>},
    {GOBO_EXTENDED(FSign), Kind::min_max, "f:f", kFloats<[](auto x) { return (x > 0) - (x < 0); }>},
    {GOBO_EXTENDED(FMin), Kind::min_max, "f:ff", kFloats<kMin>, kMinOfNaN},
    {GOBO_EXTENDED(FMax), Kind::min_max, "f:ff", kFloats<kMax>, kMaxOfNaN},
    {GOBO_EXTENDED(FClamp), Kind::min_max, "f:fff", kClamp<kMin, kMax>, kClampOfNaN},
    {GOBO_EXTENDED(NMin), Kind::min_max, "f:ff", kFloats<kNumberMin>},
    {GOBO_EXTENDED(NMax), Kind::min_max, "f:ff", kFloats<kNumberMax>},
    {GOBO_EXTENDED(NClamp), Kind::min_max, "f:fff", kClamp<kNumberMin, kNumberMax>},
    {GOBO_EXTENDED(Step), Kind::min_max, "f:ff", kFloats<[](auto edge, auto x) { return x < edge ? 0 : 1; }>},
    {GOBO_EXTENDED(FMix), Kind::mix, "f:fff", kFloats<kMix>, {.fused = kFloats<kFusedMix>}},
    {GOBO_EXTENDED(SmoothStep), Kind::mix, "f:fff", kFloats<kSmoothStep>},
    {GOBO_EXTENDED(Fma), Kind::fma, "f:fff",
     kFloats<[](auto a, auto b, auto c) { return std::fma(a, b, c); }>},
    {GOBO_EXTENDED(Ldexp), Kind::round, "f:fi", kMap<kLoadExponent, Floats, Floats, Ints>},
    {GOBO_EXTENDED(ModfStruct), Kind::round, "s:f", kRun<kModf>},
    {GOBO_EXTENDED(FrexpStruct), Kind::round, "s:f", kRun<kFrexp>},
    {GOBO_EXTENDED(Sqrt),
     Kind::sqrt,
     "f:f",
     kFloats<[](auto x) { return std::sqrt(x); }>,
     {.largest_error = error_of_root}},
    {GOBO_EXTENDED(InverseSqrt), Kind::inverse_sqrt, "f:f", kFloats<[](auto x) { return 1 / std::sqrt(x); }>,
     kInverseRoot},
    {GOBO_EXTENDED(Pow), Kind::pow, "f:ff", kCostly<kPower>, {.largest_error = error_of_power}},
    {GOBO_EXTENDED(Exp), Kind::exp, "f:f", kCostly<[](auto x) { return std::exp(x); }>, kExponential},
    {GOBO_EXTENDED(Exp2), Kind::exp, "f:f", kCostly<[](auto x) { return std::exp2(x); }>, kExponential},
    {GOBO_EXTENDED(Log), Kind::log, "f:f", kCostly<[](auto x) { return std::log(x); }>, kLogarithm},
    {GOBO_EXTENDED(Log2), Kind::log, "f:f", kCostly<[](auto x) { return std::log2(x); }>, kLogarithm},
    {GOBO_EXTENDED(Radians), Kind::mul, "f:f", kFloats<[](auto x) { return x * kRadian<decltype(x)>; }>},
    {GOBO_EXTENDED(Degrees), Kind::mul, "f:f", kFloats<[](auto x) { return x * kDegree<decltype(x)>; }>},
    {GOBO_EXTENDED(Sin), Kind::trig, "f:f", kCostly<[](auto x) { return std::sin(x); }>, kSine},
    {GOBO_EXTENDED(Cos), Kind::trig, "f:f", kCostly<[](auto x) { return std::cos(x); }>, kSine},
    {GOBO_EXTENDED(Tan),
     Kind::trig,
     "f:f",
     kCostly<[](auto x) { return std::tan(x); }>,
     {.largest_error = error_of_tangent}},
    {GOBO_EXTENDED(Asin), Kind::trig, "f:f", kCostly<[](auto x) { return std::asin(x); }>, kArcSine},
    {GOBO_EXTENDED(Acos), Kind::trig, "f:f", kCostly<[](auto x) { return std::acos(x); }>, kArcSine},
    {GOBO_EXTENDED(Atan), Kind::trig, "f:f", kCostly<[](auto x) { return std::atan(x); }>, kArcTangent},
    {GOBO_EXTENDED(Atan2), Kind::trig, "f:ff", kCostly<[](auto y, auto x) { return std::atan2(y, x); }>,
     kArcTangent},
    {GOBO_EXTENDED(Sinh), Kind::trig, "f:f", kCostly<[](auto x) { return std::sinh(x); }>, kHyperbolic},
    {GOBO_EXTENDED(Cosh), Kind::trig, "f:f", kCostly<[](auto x) { return std::cosh(x); }>, kHyperbolic},
    {GOBO_EXTENDED(Tanh), Kind::trig, "f:f", kCostly<[](auto x) { return std::tanh(x); }>},
    {GOBO_EXTENDED(Asinh), Kind::trig, "f:f", kCostly<[](auto x) { return std::asinh(x); }>},
    {GOBO_EXTENDED(Acosh), Kind::trig, "f:f", kCostly<[](auto x) { return std::acosh(x); }>},
    {GOBO_EXTENDED(Atanh), Kind::trig, "f:f", kCostly<[](auto x) { return std::atanh(x); }>},
};

}  // namespace

constinit const std::span<const Row> kFloatRows = kRows;

}  // namespace gobo::evaluate
