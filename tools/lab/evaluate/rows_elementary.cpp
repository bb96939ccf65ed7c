// GLSL.std.450: functions of one real, component by component.
#include <cmath>
#include <numbers>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

/// x to the y. What GLSL leaves undefined (x < 0, or x = 0 with y <= 0) is NaN here, so that it shows.
template <class T>
T power(T x, T y) {
    if (x < 0 || (x == 0 && y <= 0)) return std::numeric_limits<T>::quiet_NaN();
    return std::pow(x, y);
}

template <class T>
T smooth_step(T edge0, T edge1, T x) {
    const T ratio = (x - edge0) / (edge1 - edge0);
    const T t = ratio < 0 ? T(0) : ratio > 1 ? T(1) : ratio;
    return t * t * (T(3) - T(2) * t);
}

// min and max as GLSL defines them: what a NaN operand gives follows from the comparison being false.
constexpr auto kMin = [](auto x, auto y) { return y < x ? y : x; };
constexpr auto kMax = [](auto x, auto y) { return x < y ? y : x; };
// The variants that prefer what is no NaN.
constexpr auto kNumberMin = [](auto x, auto y) { return std::isnan(x) ? y : y < x ? y : x; };
constexpr auto kNumberMax = [](auto x, auto y) { return std::isnan(x) ? y : x < y ? y : x; };

// Machines that keep a NaN, whichever operand it is.
constexpr auto kNaNMin = [](auto x, auto y) { return std::isnan(y) ? y : kMin(x, y); };
constexpr auto kNaNMax = [](auto x, auto y) { return std::isnan(y) ? y : kMax(x, y); };

template <auto Min, auto Max>
inline constexpr Execution kClamp =
    kReal3<[](auto x, auto low, auto high) { return Min(Max(x, low), high); }>;

template <auto Function>
inline constexpr Execution kSlow = kCostly1<Function>;

/// Two results: the fractional and the whole part, or the significand and the exponent.
template <class T>
void modf_struct(const Operation& operation, Machine<T>& machine) {
    for (std::size_t i = 0; i < operation.count * kLanes; ++i)
        machine.reals(operation.result)[i] = std::modf(machine.reals(operation.operands[0])[i],
                                                       machine.reals(operation.result + operation.count) + i);
}

template <class T>
void frexp_struct(const Operation& operation, Machine<T>& machine) {
    for (std::size_t i = 0; i < operation.count * kLanes; ++i) {
        int exponent = 0;
        machine.reals(operation.result)[i] = std::frexp(machine.reals(operation.operands[0])[i], &exponent);
        machine.wholes(operation.result + operation.count)[i] = exponent;
    }
}

#define GOBO_EXTENDED(name) kExtended + GLSLstd450##name, #name

constexpr Row kRows[] = {
    {GOBO_EXTENDED(Round), Kind::round, "f:f", kReal1<[](auto x) { return std::round(x); }>},
    {GOBO_EXTENDED(RoundEven), Kind::round, "f:f", kReal1<[](auto x) { return std::nearbyint(x); }>},
    {GOBO_EXTENDED(Trunc), Kind::round, "f:f", kReal1<[](auto x) { return std::trunc(x); }>},
    {GOBO_EXTENDED(Floor), Kind::round, "f:f", kReal1<[](auto x) { return std::floor(x); }>},
    {GOBO_EXTENDED(Ceil), Kind::round, "f:f", kReal1<[](auto x) { return std::ceil(x); }>},
    {GOBO_EXTENDED(Fract), Kind::round, "f:f", kReal1<[](auto x) { return x - std::floor(x); }>},
    {GOBO_EXTENDED(FAbs), Kind::min_max, "f:f", kReal1<[](auto x) { return std::fabs(x); }>},
    {GOBO_EXTENDED(FSign), Kind::min_max, "f:f",
     kReal1<[](auto x) { return static_cast<decltype(x)>((x > 0) - (x < 0)); }>},
    {GOBO_EXTENDED(FMin),
     Kind::min_max,
     "f:ff",
     kReal2<kMin>,
     {.nan_kept = kReal2<kNaNMin>, .nan_dropped = kReal2<kNumberMin>}},
    {GOBO_EXTENDED(FMax),
     Kind::min_max,
     "f:ff",
     kReal2<kMax>,
     {.nan_kept = kReal2<kNaNMax>, .nan_dropped = kReal2<kNumberMax>}},
    {GOBO_EXTENDED(FClamp),
     Kind::min_max,
     "f:fff",
     kClamp<kMin, kMax>,
     {.nan_kept = kClamp<kNaNMin, kNaNMax>, .nan_dropped = kClamp<kNumberMin, kNumberMax>}},
    {GOBO_EXTENDED(NMin), Kind::min_max, "f:ff", kReal2<kNumberMin>},
    {GOBO_EXTENDED(NMax), Kind::min_max, "f:ff", kReal2<kNumberMax>},
    {GOBO_EXTENDED(NClamp), Kind::min_max, "f:fff", kClamp<kNumberMin, kNumberMax>},
    {GOBO_EXTENDED(Step), Kind::min_max, "f:ff",
     kReal2<[](auto edge, auto x) { return x < edge ? decltype(x)(0) : decltype(x)(1); }>},
    {GOBO_EXTENDED(FMix),
     Kind::mix,
     "f:fff",
     kReal3<[](auto x, auto y, auto a) { return x * (decltype(a)(1) - a) + y * a; }>,
     {.fused = kReal3<[](auto x, auto y, auto a) { return std::fma(x, decltype(a)(1) - a, y * a); }>}},
    {GOBO_EXTENDED(SmoothStep), Kind::mix, "f:fff",
     kReal3<[](auto a, auto b, auto x) { return smooth_step(a, b, x); }>},
    {GOBO_EXTENDED(Fma), Kind::fma, "f:fff",
     kReal3<[](auto a, auto b, auto c) { return std::fma(a, b, c); }>},
    {GOBO_EXTENDED(Ldexp), Kind::round, "f:fi",
     kMap2<[](auto x, auto e) { return std::ldexp(x, to_signed(e)); }, RealRows, RealRows, WholeRows>},
    {GOBO_EXTENDED(ModfStruct), Kind::round, "", {&modf_struct<float>, &modf_struct<double>}},
    {GOBO_EXTENDED(FrexpStruct), Kind::round, "", {&frexp_struct<float>, &frexp_struct<double>}},
    {GOBO_EXTENDED(Sqrt), Kind::sqrt, "f:f", kReal1<[](auto x) { return std::sqrt(x); }>},
    {GOBO_EXTENDED(InverseSqrt), Kind::inverse_sqrt, "f:f",
     kReal1<[](auto x) { return decltype(x)(1) / std::sqrt(x); }>},
    {GOBO_EXTENDED(Pow), Kind::pow, "f:ff", kCostly2<[](auto x, auto y) { return power(x, y); }>},
    {GOBO_EXTENDED(Exp), Kind::exp, "f:f", kSlow<[](auto x) { return std::exp(x); }>},
    {GOBO_EXTENDED(Exp2), Kind::exp, "f:f", kSlow<[](auto x) { return std::exp2(x); }>},
    {GOBO_EXTENDED(Log), Kind::log, "f:f", kSlow<[](auto x) { return std::log(x); }>},
    {GOBO_EXTENDED(Log2), Kind::log, "f:f", kSlow<[](auto x) { return std::log2(x); }>},
    {GOBO_EXTENDED(Radians), Kind::mul, "f:f",
     kReal1<[](auto x) { return x * (std::numbers::pi_v<decltype(x)> / decltype(x)(180)); }>},
    {GOBO_EXTENDED(Degrees), Kind::mul, "f:f",
     kReal1<[](auto x) { return x * (decltype(x)(180) / std::numbers::pi_v<decltype(x)>); }>},
    {GOBO_EXTENDED(Sin), Kind::trig, "f:f", kSlow<[](auto x) { return std::sin(x); }>},
    {GOBO_EXTENDED(Cos), Kind::trig, "f:f", kSlow<[](auto x) { return std::cos(x); }>},
    {GOBO_EXTENDED(Tan), Kind::trig, "f:f", kSlow<[](auto x) { return std::tan(x); }>},
    {GOBO_EXTENDED(Asin), Kind::trig, "f:f", kSlow<[](auto x) { return std::asin(x); }>},
    {GOBO_EXTENDED(Acos), Kind::trig, "f:f", kSlow<[](auto x) { return std::acos(x); }>},
    {GOBO_EXTENDED(Atan), Kind::trig, "f:f", kSlow<[](auto x) { return std::atan(x); }>},
    {GOBO_EXTENDED(Atan2), Kind::trig, "f:ff", kCostly2<[](auto y, auto x) { return std::atan2(y, x); }>},
    {GOBO_EXTENDED(Sinh), Kind::trig, "f:f", kSlow<[](auto x) { return std::sinh(x); }>},
    {GOBO_EXTENDED(Cosh), Kind::trig, "f:f", kSlow<[](auto x) { return std::cosh(x); }>},
    {GOBO_EXTENDED(Tanh), Kind::trig, "f:f", kSlow<[](auto x) { return std::tanh(x); }>},
    {GOBO_EXTENDED(Asinh), Kind::trig, "f:f", kSlow<[](auto x) { return std::asinh(x); }>},
    {GOBO_EXTENDED(Acosh), Kind::trig, "f:f", kSlow<[](auto x) { return std::acosh(x); }>},
    {GOBO_EXTENDED(Atanh), Kind::trig, "f:f", kSlow<[](auto x) { return std::atanh(x); }>},
};

#undef GOBO_EXTENDED

}  // namespace

std::span<const Row> elementary_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
