#include "lab/sanitize/trap_rules.hpp"

#include <algorithm>
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

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();

// Loops over numbers, component by component: the compiler makes vector instructions of them.

template <class Each, class... Number>
void for_each_lane(const Each& each, const Number*... rows) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) each(lane, rows[lane]...);
}

/// Calls each(lane, a, b, ...) for every component of the operands of those indices.
template <auto row, std::size_t first, std::size_t... others, class Each>
void for_each_number(const Step& step, const Each& each) {
    const auto& all = step.info().operands;
    for (std::uint32_t component = 0; component < all[first].count; ++component)
        for_each_lane(each, row(step, all[first], component), row(step, all[others], component)...);
}

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

template <auto test, auto row, std::size_t... operands>
Lanes test_of(const Step& step) {
    Hits hits{};
    for_each_number<row, operands...>(
        step, [&hits](std::size_t lane, auto... numbers) { hits[lane] |= test(numbers...); });
    return lanes_of(hits, step);
}
template <auto test>
constexpr auto one = &test_of<test, &float_row, 0>;
template <auto test>
constexpr auto two = &test_of<test, &float_row, 0, 1>;
template <auto test>
constexpr auto three = &test_of<test, &float_row, 0, 1, 2>;
template <auto test>
constexpr auto two_ints = &test_of<test, &int_row, 0, 1>;

/// The last two operands of all three or four, offset and number of bits: each one number for all components.
Lanes beyond_word(const Step& step) {
    const auto& operands = step.info().operands;
    const std::int32_t* offset = int_row(step, operands[operands.size() - 2], 0);
    const std::int32_t* bits = int_row(step, operands[operands.size() - 1], 0);
    Hits hits{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        // As unsigned numbers, those below 0 are far beyond; neither sum of two overflows 64 bits.
        const std::uint64_t end =
            std::uint64_t{static_cast<std::uint32_t>(offset[lane])} + static_cast<std::uint32_t>(bits[lane]);
        hits[lane] = static_cast<std::int32_t>(end > 32);
    }
    return lanes_of(hits, step);
}

/// Vectors as the formulas of length(), distance() and normalize() see them.
struct Extent {
    float largest;   ///< absolute component
    float square;    ///< of the length, as a float holds it
    float smallest;  ///< float that has all its digits
    float beyond;    ///< the least number that is infinite as such a float
};

template <class Each>
void for_each_extent(const Step& step, const Each& each) {
    const auto& operands = step.info().operands;
    std::array<float, kLanes> largest{};
    std::array<float, kLanes> square{};
    for (std::uint32_t component = 0; component < operands[0].count; ++component) {
        const float* row = float_row(step, operands[0], component);
        const float* other = operands.size() > 1 ? float_row(step, operands[1], component) : nullptr;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const float value = other == nullptr ? row[lane] : row[lane] - other[lane];
            largest[lane] = std::max(largest[lane], std::fabs(value));
            square[lane] += value * value;
        }
    }
    const float smallest = step.is_half ? 0x1p-14F : std::numeric_limits<float>::min();
    const float beyond = step.is_half ? 65520.0F : kInfinity;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        each(lane, Extent{largest[lane], square[lane], smallest, beyond});
}

template <auto test>
Lanes vector_test(const Step& step) {
    Hits hits{};
    for_each_extent(step, [&hits](std::size_t lane, Extent extent) { hits[lane] = test(extent); });
    return lanes_of(hits, step);
}

constexpr auto kIsZero = [](Extent v) { return v.square == 0 && v.largest == 0; };  // and no NaN
// Below the smallest normal number the square has lost digits, and is 0 where denormals are flushed.
constexpr auto kUnderflows = [](Extent v) { return v.largest > 0 && v.square < v.smallest; };
constexpr auto kOverflows = [](Extent v) { return v.largest < kInfinity && v.square >= v.beyond; };

constexpr auto kDivisorIsZero = [](float, float b) { return b == 0; };
constexpr auto kIsNegative = [](float a) { return a < 0; };
constexpr auto kIsNotPositive = [](float a) { return a <= 0; };
constexpr auto kIsBeyondOne = [](float a) { return std::fabs(a) > 1; };
constexpr auto kAnyIsNaN = [](float a, float b) { return (a != a) | (b != b); };
constexpr auto kNoDivisor = [](std::int32_t, std::int32_t b) { return b == 0; };
constexpr auto kHasNoQuotient = [](std::int32_t a, std::int32_t b) {
    return (a == std::numeric_limits<std::int32_t>::min()) & (b == -1);
};
constexpr auto kEitherIsNegative = [](std::int32_t a, std::int32_t b) { return (a < 0) | (b < 0); };
constexpr auto kShiftsTooFar = [](std::int32_t, std::int32_t by) { return (by < 0) | (by > 31); };

#define GOBO_STD450(name) evaluate::kExtended + GLSLstd450##name

constexpr TrapRule kTrapRules[] = {
    {spv::OpFDiv, "division by zero", false, two<kDivisorIsZero>},
    {spv::OpFMod, "mod() by zero", false, two<kDivisorIsZero>},
    {spv::OpFRem, "remainder of a division by zero", false, two<kDivisorIsZero>},
    {spv::OpSDiv, "integer division by zero", true, two_ints<kNoDivisor>},
    {spv::OpSDiv, "integer division overflows", true, two_ints<kHasNoQuotient>},
    {spv::OpUDiv, "integer division by zero", true, two_ints<kNoDivisor>},
    {spv::OpSMod, "integer remainder by zero", true, two_ints<kNoDivisor>},
    {spv::OpSMod, "integer remainder of a negative number", true, two_ints<kEitherIsNegative>},
    {spv::OpSRem, "integer remainder by zero", true, two_ints<kNoDivisor>},
    {spv::OpUMod, "integer remainder by zero", true, two_ints<kNoDivisor>},
    {spv::OpShiftLeftLogical, "shift by more than 31 bits", true, two_ints<kShiftsTooFar>},
    {spv::OpShiftRightLogical, "shift by more than 31 bits", true, two_ints<kShiftsTooFar>},
    {spv::OpShiftRightArithmetic, "shift by more than 31 bits", true, two_ints<kShiftsTooFar>},
    {spv::OpBitFieldInsert, "bit field beyond 32 bits", true, &beyond_word},
    {spv::OpBitFieldSExtract, "bit field beyond 32 bits", true, &beyond_word},
    {spv::OpBitFieldUExtract, "bit field beyond 32 bits", true, &beyond_word},
    {GOBO_STD450(Pow), "pow() of a negative number", false, two<[](float x, float) { return x < 0; }>},
    {GOBO_STD450(Pow), "pow(0, y) with y not above 0", false,
     two<[](float x, float y) { return (x == 0) & (y <= 0); }>},
    {GOBO_STD450(Sqrt), "sqrt() of a negative number", false, one<kIsNegative>},
    {GOBO_STD450(InverseSqrt), "inversesqrt() of a number not above 0", false, one<kIsNotPositive>},
    {GOBO_STD450(Log), "log() of a number not above 0", false, one<kIsNotPositive>},
    {GOBO_STD450(Log2), "log2() of a number not above 0", false, one<kIsNotPositive>},
    {GOBO_STD450(Acos), "acos() of a number beyond [-1, 1]", false, one<kIsBeyondOne>},
    {GOBO_STD450(Asin), "asin() of a number beyond [-1, 1]", false, one<kIsBeyondOne>},
    {GOBO_STD450(Acosh), "acosh() of a number below 1", false, one<[](float a) { return a < 1; }>},
    {GOBO_STD450(Atanh), "atanh() of a number not within (-1, 1)", false,
     one<[](float a) { return std::fabs(a) >= 1; }>},
    {GOBO_STD450(Atan2), "atan(0, 0)", true, two<[](float y, float x) { return (y == 0) & (x == 0); }>},
    {GOBO_STD450(SmoothStep), "smoothstep() with equal edges", true,
     three<[](float low, float high, float) { return low == high; }>},
    {GOBO_STD450(SmoothStep), "smoothstep() with its first edge above its second", true,
     three<[](float low, float high, float) { return high < low; }>},
    {GOBO_STD450(FMin), "min() fed a NaN", true, two<kAnyIsNaN>},
    {GOBO_STD450(FMax), "max() fed a NaN", true, two<kAnyIsNaN>},
    {GOBO_STD450(FClamp), "clamp() fed a NaN", true,
     three<[](float x, float low, float high) { return (x != x) | (low != low) | (high != high); }>},
    {GOBO_STD450(FClamp), "clamp() with its minimum above its maximum", true,
     three<[](float, float low, float high) { return high < low; }>},
    {GOBO_STD450(SClamp), "clamp() with its minimum above its maximum", true,
     &test_of<[](std::int32_t low, std::int32_t high) { return high < low; }, &int_row, 1, 2>},
    {GOBO_STD450(UClamp), "clamp() with its minimum above its maximum", true,
     &test_of<[](std::int32_t low, std::int32_t high) {
         return static_cast<std::uint32_t>(high) < static_cast<std::uint32_t>(low);
     },
              &int_row, 1, 2>},
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
     one<[](float a) { return !((a > -2147483904.0F) & (a < 2147483648.0F)); }>},
    {spv::OpConvertFToU, "conversion to uint out of range", true,
     one<[](float a) { return !((a > -1.0F) & (a < 4294967296.0F)); }>},
};

/// Of what is not yet reached, however near: equal numbers where one must be less.
constexpr float kTouching = std::numeric_limits<float>::denorm_min();

/// Comparisons with a NaN are false, so that it never counts as near.
void lower(float& distance, float to) {
    distance = to < distance ? to : distance;
}

/// The least of `distance` over all components of the operands of those indices.
template <auto row, auto distance, std::size_t... operands>
void nearest(const Step& step, Distances& distances) {
    for_each_number<row, operands...>(step, [&distances](std::size_t lane, auto... numbers) {
        lower(distances[lane], distance(numbers...));
    });
}

constexpr auto kApart = [](auto a, auto b) {
    return std::fabs(static_cast<float>(a) - static_cast<float>(b)) + kTouching;
};

/// A comparison's result is `Wanted`, or its operands are near each other.
template <auto Row, bool Wanted>
void comparison(const Step& step, Distances& distances) {
    const Slice& a = step.info().operands[0];
    const Slice& b = step.info().operands[1];
    for (std::uint32_t component = 0; component < a.count; ++component) {
        const auto* row_a = Row(step, a, component);
        const auto* row_b = Row(step, b, component);
        const std::int32_t* result = int_row(step, step.info().result, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const bool is_reached = (result[lane] != 0) == Wanted;
            lower(distances[lane], is_reached ? 0 : kApart(row_a[lane], row_b[lane]));
        }
    }
}

/// A truth value that other truth values make: reached or not, nothing between.
template <bool Wanted>
void truth(const Step& step, Distances& distances) {
    const std::int32_t* result = int_row(step, step.info().result, 0);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        if ((result[lane] != 0) == Wanted) distances[lane] = 0;
}

template <auto measure>
void vector_goal(const Step& step, Distances& distances) {
    for_each_extent(step, [&distances](std::size_t lane, Extent extent) {
        lower(distances[lane], measure(extent.largest));
    });
}

constexpr auto kSize = [](float a) { return std::fabs(a); };
constexpr auto kSizeOfSecond = [](auto, auto b) { return std::fabs(static_cast<float>(b)); };
constexpr auto kAboveZero = [](float a) { return a < 0 ? 0.0F : a + kTouching; };
constexpr auto kFirstAboveZero = [](float a, float) { return a < 0 ? 0.0F : a + kTouching; };
constexpr auto kBelowOne = [](float a) { return std::fabs(a) > 1 ? 0.0F : 1 - std::fabs(a) + kTouching; };
constexpr auto kSmallness = [](float largest) { return largest; };
constexpr auto kLargeness = [](float largest) { return kLargest / largest; };
constexpr auto kFirstIsLess = [](float a, float b) { return a < b ? 0.0F : kApart(a, b); };
constexpr auto kFirstIsMore = [](float a, float b) { return b < a ? 0.0F : kApart(a, b); };
constexpr auto kDifference = [](float a, float b) { return std::fabs(a - b); };
constexpr auto kLargerSize = [](float a, float b) {
    return std::fabs(a) > std::fabs(b) ? std::fabs(a) : std::fabs(b);
};
constexpr auto kBelowIntegers = [](float a) { return 2147483648.0F / std::fabs(a); };

#define GOBO_COMPARISON(name, row)             \
    {spv::Op##name, &comparison<row, true>}, { \
        spv::Op##name, &comparison<row, false> \
    }
#define GOBO_TRUTH(name)             \
    {spv::Op##name, &truth<true>}, { \
        spv::Op##name, &truth<false> \
    }

constexpr GoalRule kGoalRules[] = {
    // Decisions.
    GOBO_COMPARISON(FOrdEqual, &float_row),
    GOBO_COMPARISON(FOrdNotEqual, &float_row),
    GOBO_COMPARISON(FUnordNotEqual, &float_row),
    GOBO_COMPARISON(FOrdLessThan, &float_row),
    GOBO_COMPARISON(FOrdGreaterThan, &float_row),
    GOBO_COMPARISON(FOrdLessThanEqual, &float_row),
    GOBO_COMPARISON(FOrdGreaterThanEqual, &float_row),
    GOBO_COMPARISON(IEqual, &int_row),
    GOBO_COMPARISON(INotEqual, &int_row),
    GOBO_COMPARISON(SLessThan, &int_row),
    GOBO_COMPARISON(SGreaterThan, &int_row),
    GOBO_COMPARISON(SLessThanEqual, &int_row),
    GOBO_COMPARISON(SGreaterThanEqual, &int_row),
    GOBO_COMPARISON(ULessThan, &int_row),
    GOBO_COMPARISON(UGreaterThan, &int_row),
    GOBO_COMPARISON(ULessThanEqual, &int_row),
    GOBO_COMPARISON(UGreaterThanEqual, &int_row),
    GOBO_TRUTH(LogicalAnd),
    GOBO_TRUTH(LogicalOr),
    GOBO_TRUTH(All),
    GOBO_TRUTH(Any),
    {GOBO_STD450(FMin), nearest<&float_row, kFirstIsLess, 0, 1>},
    {GOBO_STD450(FMin), nearest<&float_row, kFirstIsMore, 0, 1>},
    {GOBO_STD450(FMax), nearest<&float_row, kFirstIsLess, 0, 1>},
    {GOBO_STD450(FMax), nearest<&float_row, kFirstIsMore, 0, 1>},
    {GOBO_STD450(Step), nearest<&float_row, kFirstIsLess, 0, 1>},
    {GOBO_STD450(Step), nearest<&float_row, kFirstIsMore, 0, 1>},
    // Traps; those of clamp() after what decides it.
    {GOBO_STD450(FClamp), nearest<&float_row, kFirstIsLess, 0, 1>},
    {GOBO_STD450(FClamp), nearest<&float_row, kFirstIsMore, 0, 2>},
    {GOBO_STD450(FClamp), nearest<&float_row, kFirstIsMore, 1, 2>},
    {GOBO_STD450(SmoothStep), nearest<&float_row, kDifference, 0, 1>},
    {GOBO_STD450(SmoothStep), nearest<&float_row, kFirstIsMore, 0, 1>},
    {spv::OpFDiv, nearest<&float_row, kSizeOfSecond, 0, 1>},
    {spv::OpFMod, nearest<&float_row, kSizeOfSecond, 0, 1>},
    {spv::OpFRem, nearest<&float_row, kSizeOfSecond, 0, 1>},
    {spv::OpSDiv, nearest<&int_row, kSizeOfSecond, 0, 1>},
    {spv::OpUDiv, nearest<&int_row, kSizeOfSecond, 0, 1>},
    {spv::OpSMod, nearest<&int_row, kSizeOfSecond, 0, 1>},
    {spv::OpSRem, nearest<&int_row, kSizeOfSecond, 0, 1>},
    {spv::OpUMod, nearest<&int_row, kSizeOfSecond, 0, 1>},
    {GOBO_STD450(Pow), nearest<&float_row, kFirstAboveZero, 0, 1>},
    {GOBO_STD450(Sqrt), nearest<&float_row, kAboveZero, 0>},
    {GOBO_STD450(InverseSqrt), nearest<&float_row, kAboveZero, 0>},
    {GOBO_STD450(Log), nearest<&float_row, kAboveZero, 0>},
    {GOBO_STD450(Log2), nearest<&float_row, kAboveZero, 0>},
    {GOBO_STD450(Acos), nearest<&float_row, kBelowOne, 0>},
    {GOBO_STD450(Asin), nearest<&float_row, kBelowOne, 0>},
    {GOBO_STD450(Atanh), nearest<&float_row, kBelowOne, 0>},
    {GOBO_STD450(Acosh), nearest<&float_row, [](float a) { return a < 1 ? 0.0F : a - 1 + kTouching; }, 0>},
    {GOBO_STD450(Atan2), nearest<&float_row, kLargerSize, 0, 1>},
    {GOBO_STD450(Normalize), vector_goal<kSmallness>},
    {GOBO_STD450(Normalize), vector_goal<kLargeness>},
    {GOBO_STD450(Length), vector_goal<kSmallness>},
    {GOBO_STD450(Length), vector_goal<kLargeness>},
    {GOBO_STD450(Distance), vector_goal<kSmallness>},
    {GOBO_STD450(Distance), vector_goal<kLargeness>},
    {GOBO_STD450(Determinant),
     [](const Step& step, Distances& distances) {
         const float* row = float_row(step, step.info().result, 0);
         for (std::size_t lane = 0; lane < kLanes; ++lane) lower(distances[lane], kSize(row[lane]));
     }},
    {spv::OpConvertFToS, nearest<&float_row, kBelowIntegers, 0>},
    {spv::OpConvertFToU, nearest<&float_row, kBelowIntegers, 0>},
    {spv::OpConvertFToU, nearest<&float_row, kAboveZero, 0>},
};

#undef GOBO_TRUTH
#undef GOBO_COMPARISON
#undef GOBO_STD450

}  // namespace

std::span<const TrapRule> trap_rules() {
    return kTrapRules;
}

std::span<const GoalRule> goal_rules() {
    return kGoalRules;
}

void measure_overflow(const Step& step, Distances& distances) {
    const Slice& result = step.info().result;
    for (std::uint32_t component = 0; component < result.count; ++component)
        for_each_lane(
            [&distances](std::size_t lane, float number) {
                const float size = std::fabs(number);
                lower(distances[lane], size > kLargest ? 0 : kLargest / size);
            },
            float_row(step, result, component));
}

Lanes not_finite(const Step& step, const Slice& slice) {
    // frexp() gives a struct: the exponents behind the significands are integers.
    const bool has_exponents = step.row().code == evaluate::kExtended + GLSLstd450FrexpStruct;
    const std::uint32_t floats =
        has_exponents ? std::min(slice.count, step.info().operands[0].count) : slice.count;
    Hits hits{};
    for (std::uint32_t component = 0; component < floats; ++component)
        for_each_lane(
            [&hits](std::size_t lane, float number) { hits[lane] |= !(std::fabs(number) <= kLargest); },
            float_row(step, slice, component));
    return lanes_of(hits, step);
}

}  // namespace gobo::sanitize
