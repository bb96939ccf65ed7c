#include "lab/prove/range.hpp"

#include <iterator>

namespace gobo::prove {
namespace {

double up(double number) {
    return std::nextafter(number, kInfinity);
}
double down(double number) {
    return std::nextafter(number, -kInfinity);
}

/// 2^grid is what sizes of numbers that are not 0 have at least.
double spacing(int grid) {
    return std::ldexp(1.0, grid);
}

int clamped_grid(int grid) {
    return std::clamp(grid, kFinestGrid * 2, 100);
}

}  // namespace

Range tidy(Range range) {
    if (range.low > range.high) return {kInfinity, -kInfinity, 0, kFinestGrid, false, range.nan};
    if (range.grid > kFinestGrid) range.least = std::max(range.least, spacing(range.grid));
    if (range.low > 0 || range.high < 0) range.zero = false;
    if (range.low > -range.least && range.low < 0) range.low = 0;
    if (range.high < range.least && range.high > 0) range.high = 0;
    if (!range.zero) {
        constexpr double kTiny = std::numeric_limits<double>::denorm_min();
        if (range.low >= 0) range.low = std::max({range.low, range.least, kTiny});
        if (range.high <= 0) range.high = std::min({range.high, -range.least, -kTiny});
        if (range.low > range.high) return {kInfinity, -kInfinity, 0, kFinestGrid, false, range.nan};
    }
    if (range.low > 0) range.least = std::max(range.least, range.low);
    if (range.high < 0) range.least = std::max(range.least, -range.high);
    if (range.low == 0 && range.high == 0) range.least = 0;
    return range;
}

Range between(double low, double high) {
    return tidy({low, high, 0, kFinestGrid, true, false});
}

Range whole_between(double low, double high) {
    return tidy({low, high, 1, 0, true, false});
}

Range exactly(double number) {
    if (std::isnan(number)) return {kInfinity, -kInfinity, 0, kFinestGrid, false, true};
    Range range{number, number, std::fabs(number), kFinestGrid, number == 0, false};
    if (number == 0) {
        range.grid = 100;
    } else if (std::isfinite(number)) {
        int exponent = 0;
        double digits = std::frexp(std::fabs(number), &exponent);
        int bits = 0;
        while (digits != std::floor(digits) && bits < 60) {
            digits *= 2;
            ++bits;
        }
        range.grid = std::max(exponent - bits, kFinestGrid);
    }
    // Flushed, a denormal counts as 0.
    if (number != 0 && std::fabs(number) < kSmallestNormal) {
        range.zero = true;
        range.low = std::min(range.low, 0.0);
        range.high = std::max(range.high, 0.0);
    }
    return range;
}

Range without_sign(const Range& range) {
    if (range.has_no_number() || range.low >= 0) return range;
    if (range.high >= 0) return kAnyUint;
    return whole_between(range.low + 0x1p32, range.high + 0x1p32);
}

Range hull(const Range& a, const Range& b) {
    if (a.has_no_number() || b.has_no_number()) {
        Range one = a.has_no_number() ? b : a;
        one.nan = a.nan || b.nan;
        return one;
    }
    const auto nonzero_least = [](const Range& r) { return r.low == 0 && r.high == 0 ? kInfinity : r.least; };
    double least = std::min(nonzero_least(a), nonzero_least(b));
    if (least == kInfinity) least = 0;
    return tidy({std::min(a.low, b.low), std::max(a.high, b.high), least, std::min(a.grid, b.grid),
                 a.zero || b.zero, a.nan || b.nan});
}

Range both(const Range& a, const Range& b) {
    return tidy({std::max(a.low, b.low), std::min(a.high, b.high), std::max(a.least, b.least),
                 std::max(a.grid, b.grid), a.zero && b.zero, a.nan && b.nan});
}

Range rounded(Range real) {
    if (real.has_no_number()) return real;
    real.low = nearest_float(real.low);
    real.high = nearest_float(real.high);
    if (real.grid > kFinestGrid) real.least = std::max(real.least, spacing(real.grid));
    // Below the smallest normal number, results are rounded to multiples of the smallest or flushed to 0.
    real.grid = std::max(real.grid, kFinestGrid);
    if (real.low > 0) real.least = std::max(real.least, real.low);
    if (real.high < 0) real.least = std::max(real.least, -real.high);
    if (real.least < kSmallestNormal && real.low < kSmallestNormal && real.high > -kSmallestNormal) {
        real.zero = true;
        real.least = 0;
        if (real.low > 0) real.low = 0;
        if (real.high < 0) real.high = 0;
    } else {
        real.least = nearest_float(real.least);
    }
    return tidy(real);
}

Range widened(Range range, int units) {
    if (range.has_no_number()) return range;
    const double low = range.low;
    const double high = range.high;
    for (int i = 0; i < units; ++i) {
        if (std::isfinite(range.low) && low != 0) range.low = float_below(range.low);
        if (std::isfinite(range.high) && high != 0) range.high = float_above(range.high);
        if (range.least > 0) range.least = float_below(range.least);
    }
    if (low >= 0) range.low = std::max(range.low, 0.0);
    if (high <= 0) range.high = std::min(range.high, 0.0);
    range.grid = kFinestGrid;
    return tidy(range);
}

Range widened_by(Range range, double amount) {
    if (range.has_no_number()) return range;
    range.low = down(range.low - amount);
    range.high = up(range.high + amount);
    range.least = 0;
    range.grid = kFinestGrid;
    range.zero = range.low <= 0 && range.high >= 0;
    return tidy(range);
}

Range negated(Range a) {
    std::swap(a.low, a.high);
    a.low = -a.low;
    a.high = -a.high;
    return a;
}

Range size_of(const Range& a) {
    if (a.has_no_number()) return a;
    Range result = a;
    result.high = a.size();
    result.low = a.low > 0 ? a.low : a.high < 0 ? -a.high : 0;
    return tidy(result);
}

Range sum(const Range& a, const Range& b) {
    if (a.has_no_number() || b.has_no_number())
        return {kInfinity, -kInfinity, 0, kFinestGrid, false, a.nan || b.nan};
    // Sums of floats are exact in doubles unless their sizes are very different: then one more step outwards
    // counts little.
    const auto exact = [](double x, double y, double total) { return total - x == y && total - y == x; };
    double low = a.low + b.low;
    double high = a.high + b.high;
    if (!exact(a.low, b.low, low)) low = down(low);
    if (!exact(a.high, b.high, high)) high = up(high);
    return tidy({low, high, 0, std::min(a.grid, b.grid), true, a.nan || b.nan});
}

Range product(const Range& a, const Range& b) {
    if (a.has_no_number() || b.has_no_number())
        return {kInfinity, -kInfinity, 0, kFinestGrid, false, a.nan || b.nan};
    // Of floats exact; of others rounded, which a step outwards makes good.
    const auto times = [](double x, double y) { return x == 0 || y == 0 ? 0.0 : x * y; };
    const double corners[] = {times(a.low, b.low), times(a.low, b.high), times(a.high, b.low),
                              times(a.high, b.high)};
    const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
    return tidy({*low, *high, times(a.least, b.least), clamped_grid(a.grid + b.grid),
                 a.holds_zero() || b.holds_zero(), a.nan || b.nan});
}

Range square(const Range& a) {
    if (a.has_no_number()) return a;
    const Range size = size_of(a);
    return tidy({size.low * size.low, size.high * size.high, a.least * a.least, clamped_grid(2 * a.grid),
                 a.holds_zero(), a.nan});
}

Range quotient(const Range& a, const Range& b) {
    if (a.has_no_number() || b.has_no_number())
        return {kInfinity, -kInfinity, 0, kFinestGrid, false, a.nan || b.nan};
    Range result;
    if (b.low > 0 || b.high < 0) {
        const double corners[] = {a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high};
        const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
        result.low = *low;
        result.high = *high;
    } else {
        const double most = a.size() / std::max(b.least, kSmallestFloat);
        result.low = -most;
        result.high = most;
    }
    result.least = a.least / b.size();
    result.zero = a.holds_zero();
    result.nan = a.nan || b.nan;
    return tidy(result);
}

Range smaller(const Range& a, const Range& b) {
    if (a.has_no_number() || b.has_no_number()) return hull(a, b);
    Range result = hull(a, b);
    result.low = std::min(a.low, b.low);
    result.high = std::min(a.high, b.high);
    return tidy(result);
}

Range larger(const Range& a, const Range& b) {
    return negated(smaller(negated(a), negated(b)));
}

Range finite_part(Range range) {
    range.nan = false;
    range.low = std::max(range.low, -kLargestFloat);
    range.high = std::min(range.high, kLargestFloat);
    return tidy(range);
}

bool is_infinite(const Range& range) {
    return !range.has_no_number() && (range.low < -kLargestFloat || range.high > kLargestFloat);
}

Range within(double low, double high, bool nan) {
    Range range = between(low, high);
    range.nan = nan;
    return range;
}

}  // namespace gobo::prove
