#include "lab/sanitize/trap_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::kLanes;
using evaluate::Slice;
using Step = evaluate::Step<float>;

/// What a test finds, lane by lane: 0 or not.
using Hits = std::array<std::int32_t, kLanes>;

Lanes lanes_of(const Hits& hits, const Step& step) {
    std::int32_t any = 0;
    for (const std::int32_t hit : hits) any |= hit;
    if (any == 0) return 0;
    Lanes lanes = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes |= static_cast<Lanes>(hits[lane] != 0) << lane;
    return lanes & step.lanes;
}

// The tests of reals and of whole numbers, component by component: the compiler makes vector instructions of
// these loops.
template <auto Test>
Lanes one(const Step& step) {
    const Slice& a = step.info().operands[0];
    Hits hits{};
    for (std::uint32_t component = 0; component < a.count; ++component) {
        const float* row = real_row(step, a, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) hits[lane] |= Test(row[lane]);
    }
    return lanes_of(hits, step);
}

template <auto Test>
Lanes two(const Step& step) {
    const Slice& a = step.info().operands[0];
    const Slice& b = step.info().operands[1];
    Hits hits{};
    for (std::uint32_t component = 0; component < a.count; ++component) {
        const float* row_a = real_row(step, a, component);
        const float* row_b = real_row(step, b, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) hits[lane] |= Test(row_a[lane], row_b[lane]);
    }
    return lanes_of(hits, step);
}

template <auto Test>
Lanes three(const Step& step) {
    const Slice& a = step.info().operands[0];
    const Slice& b = step.info().operands[1];
    const Slice& c = step.info().operands[2];
    Hits hits{};
    for (std::uint32_t component = 0; component < a.count; ++component) {
        const float* row_a = real_row(step, a, component);
        const float* row_b = real_row(step, b, component);
        const float* row_c = real_row(step, c, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            hits[lane] |= Test(row_a[lane], row_b[lane], row_c[lane]);
    }
    return lanes_of(hits, step);
}

template <auto Test>
Lanes whole_two(const Step& step) {
    const Slice& a = step.info().operands[0];
    const Slice& b = step.info().operands[1];
    Hits hits{};
    for (std::uint32_t component = 0; component < a.count; ++component) {
        const std::int32_t* row_a = whole_row(step, a, component);
        const std::int32_t* row_b = whole_row(step, b, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) hits[lane] |= Test(row_a[lane], row_b[lane]);
    }
    return lanes_of(hits, step);
}

/// The last two operands of all three or four, offset and number of bits: each one number for all components.
Lanes beyond_word(const Step& step) {
    const auto& operands = step.info().operands;
    const std::int32_t* offset = whole_row(step, operands[operands.size() - 2], 0);
    const std::int32_t* bits = whole_row(step, operands[operands.size() - 1], 0);
    Hits hits{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        // As unsigned numbers, those below 0 are far beyond; neither sum of two overflows 64 bits.
        const std::uint64_t end =
            std::uint64_t{static_cast<std::uint32_t>(offset[lane])} + static_cast<std::uint32_t>(bits[lane]);
        hits[lane] = static_cast<std::int32_t>(end > 32);
    }
    return lanes_of(hits, step);
}

/// A vector as the formulas of length() and normalize() see it.
struct Extent {
    float largest;  ///< absolute component
    float square;   ///< of the length, as a float holds it
};
template <auto Test>
Lanes vector_test(const Step& step) {
    const auto& operands = step.info().operands;
    std::array<float, kLanes> largest{};
    std::array<float, kLanes> square{};
    for (std::uint32_t component = 0; component < operands[0].count; ++component) {
        const float* row = real_row(step, operands[0], component);
        const float* other = operands.size() > 1 ? real_row(step, operands[1], component) : nullptr;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const float value = other == nullptr ? row[lane] : row[lane] - other[lane];
            largest[lane] = std::max(largest[lane], std::fabs(value));
            square[lane] += value * value;
        }
    }
    Hits hits{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) hits[lane] = Test(Extent{largest[lane], square[lane]});
    return lanes_of(hits, step);
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr auto kIsZero = [](Extent v) { return v.largest == 0; };
// Below the smallest normal number the square has lost digits, and is 0 where denormals are flushed.
constexpr auto kUnderflows = [](Extent v) {
    return v.largest > 0 && v.square < std::numeric_limits<float>::min();
};
constexpr auto kOverflows = [](Extent v) { return v.largest < kInfinity && v.square == kInfinity; };

constexpr auto kDivisorIsZero = [](float, float b) { return b == 0; };
constexpr auto kIsNegative = [](float a) { return a < 0; };
constexpr auto kIsNotPositive = [](float a) { return a <= 0; };
constexpr auto kIsBeyondOne = [](float a) { return std::fabs(a) > 1; };
constexpr auto kAnyIsNaN = [](float a, float b) { return (a != a) | (b != b); };
constexpr auto kNoDivisor = [](std::int32_t, std::int32_t b) { return b == 0; };
constexpr auto kEitherIsNegative = [](std::int32_t a, std::int32_t b) { return (a < 0) | (b < 0); };
constexpr auto kShiftsTooFar = [](std::int32_t, std::int32_t by) { return (by < 0) | (by > 31); };

#define GOBO_STD450(name) evaluate::kExtended + GLSLstd450##name

constexpr TrapRule kRules[] = {
    {spv::OpFDiv, "division by zero", false, &two<kDivisorIsZero>},
    {spv::OpFMod, "mod() by zero", false, &two<kDivisorIsZero>},
    {spv::OpFRem, "remainder of a division by zero", false, &two<kDivisorIsZero>},
    {spv::OpSDiv, "integer division by zero", true, &whole_two<kNoDivisor>},
    {spv::OpUDiv, "integer division by zero", true, &whole_two<kNoDivisor>},
    {spv::OpSMod, "integer remainder by zero", true, &whole_two<kNoDivisor>},
    {spv::OpSMod, "integer remainder of a negative number", true, &whole_two<kEitherIsNegative>},
    {spv::OpSRem, "integer remainder by zero", true, &whole_two<kNoDivisor>},
    {spv::OpUMod, "integer remainder by zero", true, &whole_two<kNoDivisor>},
    {spv::OpShiftLeftLogical, "shift by more than 31 bits", true, &whole_two<kShiftsTooFar>},
    {spv::OpShiftRightLogical, "shift by more than 31 bits", true, &whole_two<kShiftsTooFar>},
    {spv::OpShiftRightArithmetic, "shift by more than 31 bits", true, &whole_two<kShiftsTooFar>},
    {spv::OpBitFieldInsert, "bit field beyond 32 bits", true, &beyond_word},
    {spv::OpBitFieldSExtract, "bit field beyond 32 bits", true, &beyond_word},
    {spv::OpBitFieldUExtract, "bit field beyond 32 bits", true, &beyond_word},
    {GOBO_STD450(Pow), "pow() of a negative number", false, &two<[](float x, float) { return x < 0; }>},
    {GOBO_STD450(Pow), "pow(0, y) with y not above 0", false,
     &two<[](float x, float y) { return (x == 0) & (y <= 0); }>},
    {GOBO_STD450(Sqrt), "sqrt() of a negative number", false, &one<kIsNegative>},
    {GOBO_STD450(InverseSqrt), "inversesqrt() of a number not above 0", false, &one<kIsNotPositive>},
    {GOBO_STD450(Log), "log() of a number not above 0", false, &one<kIsNotPositive>},
    {GOBO_STD450(Log2), "log2() of a number not above 0", false, &one<kIsNotPositive>},
    {GOBO_STD450(Acos), "acos() of a number beyond [-1, 1]", false, &one<kIsBeyondOne>},
    {GOBO_STD450(Asin), "asin() of a number beyond [-1, 1]", false, &one<kIsBeyondOne>},
    {GOBO_STD450(Acosh), "acosh() of a number below 1", false, &one<[](float a) { return a < 1; }>},
    {GOBO_STD450(Atanh), "atanh() of a number not within (-1, 1)", false,
     &one<[](float a) { return std::fabs(a) >= 1; }>},
    {GOBO_STD450(Atan2), "atan(0, 0)", true, &two<[](float y, float x) { return (y == 0) & (x == 0); }>},
    {GOBO_STD450(SmoothStep), "smoothstep() with equal edges", true,
     &three<[](float low, float high, float) { return low == high; }>},
    {GOBO_STD450(SmoothStep), "smoothstep() with its first edge above its second", true,
     &three<[](float low, float high, float) { return high < low; }>},
    {GOBO_STD450(FMin), "min() fed a NaN", true, &two<kAnyIsNaN>},
    {GOBO_STD450(FMax), "max() fed a NaN", true, &two<kAnyIsNaN>},
    {GOBO_STD450(FClamp), "clamp() fed a NaN", true,
     &three<[](float x, float low, float high) { return (x != x) | (low != low) | (high != high); }>},
    {GOBO_STD450(FClamp), "clamp() with its minimum above its maximum", true,
     &three<[](float, float low, float high) { return high < low; }>},
    {GOBO_STD450(Normalize), "normalize() of a zero vector", true, &vector_test<kIsZero>},
    {GOBO_STD450(Normalize), "normalize() underflows: the square of the length is too small", true,
     &vector_test<kUnderflows>},
    {GOBO_STD450(Normalize), "normalize() overflows: the square of the length is too large", true,
     &vector_test<kOverflows>},
    {GOBO_STD450(Length), "length() underflows: its square is too small", true, &vector_test<kUnderflows>},
    {GOBO_STD450(Length), "length() overflows: its square is too large", true, &vector_test<kOverflows>},
    {GOBO_STD450(Distance), "distance() underflows: its square is too small", true,
     &vector_test<kUnderflows>},
    {GOBO_STD450(Distance), "distance() overflows: its square is too large", true, &vector_test<kOverflows>},
    {GOBO_STD450(MatrixInverse), "inverse() of a singular matrix", false,
     [](const Step& step) { return step.lanes; }},
    {spv::OpConvertFToS, "conversion to int out of range", true,
     &one<[](float a) { return !((a > -2147483904.0F) & (a < 2147483648.0F)); }>},
    {spv::OpConvertFToU, "conversion to uint out of range", true,
     &one<[](float a) { return !((a > -1.0F) & (a < 4294967296.0F)); }>},
};

#undef GOBO_STD450

}  // namespace

std::span<const TrapRule> trap_rules() {
    return kRules;
}

}  // namespace gobo::sanitize
