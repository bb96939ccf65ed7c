#include "lab/sanitize/goals.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/sanitize/trap_rules.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::kLanes;
using evaluate::Slice;
using Step = evaluate::Step<float>;

constexpr float kLargest = std::numeric_limits<float>::max();
/// Of what is not yet reached, however near: equal numbers where one must be less.
constexpr float kTouching = std::numeric_limits<float>::denorm_min();

/// Comparisons with a NaN are false, so that it never counts as near.
void lower(float& distance, float to) {
    distance = to < distance ? to : distance;
}

template <auto Distance>
void one(const Step& step, Distances& distances) {
    const Slice& a = step.info().operands[0];
    for (std::uint32_t component = 0; component < a.count; ++component) {
        const float* row = real_row(step, a, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) lower(distances[lane], Distance(row[lane]));
    }
}

/// Of two operands, as reals or as whole numbers.
template <auto Row, auto Distance, std::size_t First = 0, std::size_t Second = 1>
void two(const Step& step, Distances& distances) {
    const Slice& a = step.info().operands[First];
    const Slice& b = step.info().operands[Second];
    for (std::uint32_t component = 0; component < a.count; ++component) {
        const auto* row_a = Row(step, a, component);
        const auto* row_b = Row(step, b, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            lower(distances[lane], Distance(row_a[lane], row_b[lane]));
    }
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
        const std::int32_t* result = whole_row(step, step.info().result, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const bool is_reached = (result[lane] != 0) == Wanted;
            lower(distances[lane], is_reached ? 0 : kApart(row_a[lane], row_b[lane]));
        }
    }
}

/// A truth value that other truth values make: reached or not, nothing between.
template <bool Wanted>
void truth(const Step& step, Distances& distances) {
    const std::int32_t* result = whole_row(step, step.info().result, 0);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        if ((result[lane] != 0) == Wanted) distances[lane] = 0;
}

template <auto Measure>
void vector_test(const Step& step, Distances& distances) {
    const auto& operands = step.info().operands;
    Distances largest{};
    for (std::uint32_t component = 0; component < operands[0].count; ++component) {
        const float* row = real_row(step, operands[0], component);
        const float* other = operands.size() > 1 ? real_row(step, operands[1], component) : nullptr;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const float value = std::fabs(other == nullptr ? row[lane] : row[lane] - other[lane]);
            largest[lane] = value > largest[lane] ? value : largest[lane];
        }
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) lower(distances[lane], Measure(largest[lane]));
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

#define GOBO_STD450(name) evaluate::kExtended + GLSLstd450##name
#define GOBO_COMPARISON(name, row)             \
    {spv::Op##name, &comparison<row, true>}, { \
        spv::Op##name, &comparison<row, false> \
    }
#define GOBO_TRUTH(name)             \
    {spv::Op##name, &truth<true>}, { \
        spv::Op##name, &truth<false> \
    }

constexpr GoalRule kRules[] = {
    // Decisions.
    GOBO_COMPARISON(FOrdEqual, &real_row),
    GOBO_COMPARISON(FOrdNotEqual, &real_row),
    GOBO_COMPARISON(FUnordNotEqual, &real_row),
    GOBO_COMPARISON(FOrdLessThan, &real_row),
    GOBO_COMPARISON(FOrdGreaterThan, &real_row),
    GOBO_COMPARISON(FOrdLessThanEqual, &real_row),
    GOBO_COMPARISON(FOrdGreaterThanEqual, &real_row),
    GOBO_COMPARISON(IEqual, &whole_row),
    GOBO_COMPARISON(INotEqual, &whole_row),
    GOBO_COMPARISON(SLessThan, &whole_row),
    GOBO_COMPARISON(SGreaterThan, &whole_row),
    GOBO_COMPARISON(SLessThanEqual, &whole_row),
    GOBO_COMPARISON(SGreaterThanEqual, &whole_row),
    GOBO_COMPARISON(ULessThan, &whole_row),
    GOBO_COMPARISON(UGreaterThan, &whole_row),
    GOBO_COMPARISON(ULessThanEqual, &whole_row),
    GOBO_COMPARISON(UGreaterThanEqual, &whole_row),
    GOBO_TRUTH(LogicalAnd),
    GOBO_TRUTH(LogicalOr),
    GOBO_TRUTH(All),
    GOBO_TRUTH(Any),
    {GOBO_STD450(FMin), &two<&real_row, kFirstIsLess>},
    {GOBO_STD450(FMin), &two<&real_row, kFirstIsMore>},
    {GOBO_STD450(FMax), &two<&real_row, kFirstIsLess>},
    {GOBO_STD450(FMax), &two<&real_row, kFirstIsMore>},
    {GOBO_STD450(Step), &two<&real_row, kFirstIsLess>},
    {GOBO_STD450(Step), &two<&real_row, kFirstIsMore>},
    // Traps; those of clamp() after what decides it.
    {GOBO_STD450(FClamp), &two<&real_row, kFirstIsLess>},
    {GOBO_STD450(FClamp), &two<&real_row, kFirstIsMore, 0, 2>},
    {GOBO_STD450(FClamp), &two<&real_row, kFirstIsMore, 1, 2>},
    {GOBO_STD450(SmoothStep), &two<&real_row, kDifference>},
    {GOBO_STD450(SmoothStep), &two<&real_row, kFirstIsMore>},
    {spv::OpFDiv, &two<&real_row, kSizeOfSecond>},
    {spv::OpFMod, &two<&real_row, kSizeOfSecond>},
    {spv::OpFRem, &two<&real_row, kSizeOfSecond>},
    {spv::OpSDiv, &two<&whole_row, kSizeOfSecond>},
    {spv::OpUDiv, &two<&whole_row, kSizeOfSecond>},
    {spv::OpSMod, &two<&whole_row, kSizeOfSecond>},
    {spv::OpSRem, &two<&whole_row, kSizeOfSecond>},
    {spv::OpUMod, &two<&whole_row, kSizeOfSecond>},
    {GOBO_STD450(Pow), &two<&real_row, kFirstAboveZero>},
    {GOBO_STD450(Sqrt), &one<kAboveZero>},
    {GOBO_STD450(InverseSqrt), &one<kAboveZero>},
    {GOBO_STD450(Log), &one<kAboveZero>},
    {GOBO_STD450(Log2), &one<kAboveZero>},
    {GOBO_STD450(Acos), &one<kBelowOne>},
    {GOBO_STD450(Asin), &one<kBelowOne>},
    {GOBO_STD450(Atanh), &one<kBelowOne>},
    {GOBO_STD450(Acosh), &one<[](float a) { return a < 1 ? 0.0F : a - 1 + kTouching; }>},
    {GOBO_STD450(Atan2), &two<&real_row, kLargerSize>},
    {GOBO_STD450(Normalize), &vector_test<kSmallness>},
    {GOBO_STD450(Normalize), &vector_test<kLargeness>},
    {GOBO_STD450(Length), &vector_test<kSmallness>},
    {GOBO_STD450(Length), &vector_test<kLargeness>},
    {GOBO_STD450(Distance), &vector_test<kSmallness>},
    {GOBO_STD450(Distance), &vector_test<kLargeness>},
    {GOBO_STD450(Determinant),
     [](const Step& step, Distances& distances) {
         const float* row = real_row(step, step.info().result, 0);
         for (std::size_t lane = 0; lane < kLanes; ++lane) lower(distances[lane], kSize(row[lane]));
     }},
    {spv::OpConvertFToS, &one<kBelowIntegers>},
    {spv::OpConvertFToU, &one<kBelowIntegers>},
    {spv::OpConvertFToU, &one<kAboveZero>},
};

#undef GOBO_TRUTH
#undef GOBO_COMPARISON
#undef GOBO_STD450

}  // namespace

std::span<const GoalRule> goal_rules() {
    return kRules;
}

void measure_overflow(const Step& step, Distances& distances) {
    const Slice& result = step.info().result;
    for (std::uint32_t component = 0; component < result.count; ++component) {
        const float* row = real_row(step, result, component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const float size = std::fabs(row[lane]);
            lower(distances[lane], size > kLargest ? 0 : kLargest / size);
        }
    }
}

}  // namespace gobo::sanitize
