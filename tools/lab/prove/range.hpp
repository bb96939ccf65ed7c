// What a number may be on any variant of arithmetic: intervals of floats, integers and booleans, and the
// arithmetic of them.
#pragma once

#include <algorithm>
#include <limits>

#include "core/numbers.hpp"

namespace gobo::prove {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kLargestFloat = std::numeric_limits<float>::max();
inline constexpr double kSmallestNormal = std::numeric_limits<float>::min();
inline constexpr double kSmallestFloat = std::numeric_limits<float>::denorm_min();
/// Half the distance from 1 to the next float.
inline constexpr double kRounding = 0x1p-24;
/// Every float is a multiple of 2 to this power.
inline constexpr int kFinestGrid = -149;

/// The numbers between low and high; of these not 0 unless `zero`, and nothing nearer to 0 than `least` but 0
/// itself. Multiples of 2^grid. NaN too where `nan`. Integers and booleans as their values. On the variant
/// that flushes denormals, a number is what operations take it for.
struct Range {
    double low = -kInfinity;
    double high = kInfinity;
    double least = 0;
    int grid = kFinestGrid;
    bool zero = true;
    bool nan = false;

    /// No number; NaN perhaps.
    [[nodiscard]] bool has_no_number() const { return low > high; }
    [[nodiscard]] bool is_empty() const { return low > high && !nan; }
    [[nodiscard]] bool is_finite() const { return !nan && low >= -kLargestFloat && high <= kLargestFloat; }
    [[nodiscard]] bool is_one() const { return low == high && !nan; }
    [[nodiscard]] bool holds_zero() const { return zero && low <= 0 && high >= 0; }
    /// The largest absolute value.
    [[nodiscard]] double size() const { return std::max(std::fabs(low), std::fabs(high)); }
    /// The smallest absolute value.
    [[nodiscard]] double smallest() const {
        if (holds_zero()) return 0;
        return std::max({least, low, -high});
    }
    friend bool operator==(const Range&, const Range&) = default;
};

inline constexpr Range kNothing{kInfinity, -kInfinity, 0, kFinestGrid, false, false};
inline constexpr Range kAnything{-kInfinity, kInfinity, 0, kFinestGrid, true, true};
inline constexpr Range kTruth{0, 1, 1, 0, true, false};
/// Integers without a sign are held as the signed ones with the same bits.
inline constexpr Range kAnyInt{-2147483648.0, 2147483647.0, 1, 0, true, false};
inline constexpr Range kAnyUint{0, 4294967295.0, 1, 0, true, false};

/// Makes the parts agree with each other.
[[nodiscard]] Range tidy(Range range);
[[nodiscard]] Range between(double low, double high);
[[nodiscard]] Range whole_between(double low, double high);
[[nodiscard]] Range exactly(double number);

/// What signed integers are without a sign: as they are shown to people.
[[nodiscard]] Range without_sign(const Range& range);

[[nodiscard]] Range hull(const Range& a, const Range& b);
[[nodiscard]] Range both(const Range& a, const Range& b);

/// The floats that an operation gives whose results in real numbers, or in floats already, are those of
/// `real`: rounded to nearest; with what flushing makes of denormals.
[[nodiscard]] Range rounded(Range real);
/// Each end moved outwards by so many units in the last place.
[[nodiscard]] Range widened(Range range, int units);
/// By an absolute amount.
[[nodiscard]] Range widened_by(Range range, double amount);

// In real numbers (of doubles, rounded outwards where they do not hold the result); none is infinite.
[[nodiscard]] Range negated(Range a);
[[nodiscard]] Range size_of(const Range& a);
[[nodiscard]] Range sum(const Range& a, const Range& b);
[[nodiscard]] Range product(const Range& a, const Range& b);
[[nodiscard]] Range square(const Range& a);
/// `b` does not hold 0.
[[nodiscard]] Range quotient(const Range& a, const Range& b);
[[nodiscard]] Range smaller(const Range& a, const Range& b);
[[nodiscard]] Range larger(const Range& a, const Range& b);

/// An operand without what is not finite.
[[nodiscard]] Range finite_part(Range range);
/// Whether it may be an infinity.
[[nodiscard]] bool is_infinite(const Range& range);
/// All numbers between both ends.
[[nodiscard]] Range within(double low, double high, bool nan = false);

}  // namespace gobo::prove
