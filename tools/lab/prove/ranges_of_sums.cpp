// Sums, and sums of products, in all orders in which variants of arithmetic add.
#include <algorithm>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/ranges.hpp"

namespace gobo::prove {
namespace {

/// The real numbers that are rounded to floats of the range.
Range before_rounding(Range range) {
    if (range.has_no_number()) return range;
    const auto halfway = [](double end, double next) {
        return std::isfinite(next) && std::isfinite(end) ? (end + next) / 2 : next;
    };
    range.low = std::min(halfway(range.low, float_below(range.low)),
                         std::fabs(range.low) < 2 * kSmallestNormal ? -2 * kSmallestNormal : range.low);
    range.high = std::max(halfway(range.high, float_above(range.high)),
                          std::fabs(range.high) < 2 * kSmallestNormal ? 2 * kSmallestNormal : range.high);
    range.least = 0;
    range.zero = range.low <= 0 && range.high >= 0;
    range.grid = 2 * kFinestGrid;
    return range;
}

}  // namespace

/// x + y or x - y, as written, with a product or with terms of either that other variants take instead.
void Ranges::evaluate_sum(const Expression& expression, const std::uint32_t* operands, Known& known) const {
    const Known& x = known_[operands[0]];
    Known y = known_[operands[1]];
    const bool is_difference = expression.code == spv::OpFSub;
    if (is_difference) {
        y.range = negated(y.range);
        y.product = negated(y.product);
        for (TermsCases& terms : y.terms) terms.negate();
    }
    const Range a = finite_part(x.range);
    const Range b = finite_part(y.range);
    Range real = sum(a, b);
    const bool is_plain =
        expression.is_precise || (!x.has_product && !y.has_product && !x.has_terms && !y.has_terms);
    if (is_difference && is_plain) {
        const std::uint32_t first = expressions_.origin(operands[0]);
        const std::uint32_t second = expressions_.origin(operands[1]);
        bool is_strict = false;
        if (first == second) {
            real = exactly(0);
        } else if (is_before(second, first, is_strict)) {
            real.low = std::max(real.low, 0.0);
            real.zero = real.zero && !is_strict;
            real = tidy(real);
        } else if (is_before(first, second, is_strict)) {
            real.high = std::min(real.high, 0.0);
            real.zero = real.zero && !is_strict;
            real = tidy(real);
        }
        if (const auto rounding = rounding_of_sum(operands[0], operands[1])) {
            real = both(real, *rounding);
            real = tidy(real);
        }
        // x - floor(x)
        const Expression& subtracted = expressions_.all[second];
        if (subtracted.code == extended(GLSLstd450Floor) &&
            expressions_.origin(expressions_.operand(second, 0)) == first)
            real = both(real, within(0, 1));
    }
    known.range = rounded(real);
    const auto add = [&](const Range& other, double sizes) {
        // Not further from the plain sum than a few roundings of what is added.
        const Range near = widened_by(known.range, 8 * kRounding * sizes + 4 * kSmallestNormal);
        Range one = rounded(other);
        one = {
            std::max(one.low, near.low), std::min(one.high, near.high), one.least, one.grid, one.zero, false};
        return tidy(one);
    };
    if (!expression.is_precise) {
        Range all = known.range;
        const auto fuse = [&](Range product, const Range& rounded_product, const Range& other) {
            if (product.has_no_number()) return;
            product = both(product, before_rounding(rounded_product));
            if (product.has_no_number()) return;
            all = hull(all, add(sum(product, other), product.size() + other.size()));
        };
        if (x.has_product) fuse(x.product, a, b);
        if (y.has_product) fuse(y.product, b, a);
        known.has_terms = known.always_has_terms = true;
        const bool takes_first = x.has_terms && x.always_has_terms;
        for (std::size_t variant = 0; variant < known.terms.size(); ++variant) {
            TermsCases& now = known.terms[variant];
            if (!takes_first && !y.always_has_terms) now.add(Terms{a, b});
            const auto regroup = [&](Terms terms, const Range& of_sum, const Range& other) {
                terms = {finite_part(terms.first), finite_part(terms.second)};
                // Their sum is what is known as a float.
                const Range near = before_rounding(of_sum);
                terms.second = both(terms.second, sum(near, negated(terms.first)));
                if (terms.first.has_no_number() || terms.second.has_no_number()) return;
                const double sizes = terms.first.size() + terms.second.size() + other.size();
                const auto take = [&](const Terms& next) {
                    all = hull(all, add(sum(next.first, next.second), sizes));
                    now.add(next);
                };
                // What cancels is gone.
                const Range opposite = negated(other);
                const bool always_cancels =
                    opposite.is_one() && terms.first.is_one() && opposite.low == terms.first.low;
                if (!both(opposite, terms.first).is_empty()) take({terms.second, exactly(0)});
                if (always_cancels) return;
                if (!both(opposite, terms.second).is_empty()) take({terms.first, exactly(0)});
                take(variant == 0 ? Terms{terms.first, rounded(sum(terms.second, other))}
                                  : Terms{rounded(sum(terms.first, other)), terms.second});
            };
            if (x.has_terms)
                for (std::size_t i = 0; i < x.terms[variant].count; ++i)
                    regroup(x.terms[variant].cases[i], a, b);
            if (y.has_terms && !takes_first)
                for (std::size_t i = 0; i < y.terms[variant].count; ++i)
                    regroup(y.terms[variant].cases[i], b, a);
            if (now.count == 0) now.add(Terms{a, b});
        }
        known.range = all;
    }
    known.makes_infinity = is_infinite(known.range);
    known.of_finite = known.range;
    known.makes_nan = false;
    if (x.range.nan || y.range.nan || is_infinite(x.range) || is_infinite(y.range)) known.range = kAnything;
}

/// Also of lengths: the left and the right factors may be the same.
Range Ranges::sum_of_products(const std::uint32_t* left, const std::uint32_t* right,
                              std::uint32_t terms) const {
    Range total = exactly(0);
    double sizes = 0;
    bool is_square = true;
    bool is_positive = true;
    for (std::uint32_t i = 0; i < terms; ++i) {
        const Range a = finite_part(known_[left[i]].range);
        const Range b = finite_part(known_[right[i]].range);
        const bool is_same = expressions_.origin(left[i]) == expressions_.origin(right[i]);
        is_square = is_square && is_same;
        const Range term = is_same ? square(both(a, b)) : product(a, b);
        if (term.has_no_number()) return term;
        is_positive = is_positive && term.low >= 0;
        total = sum(total, term);
        sizes += term.size();
    }
    const int grid = total.grid;
    if (terms > 1) {
        const double error = (terms + 1) * kRounding * 1.001 * sizes + 2 * terms * kSmallestNormal;
        total = widened_by(total, error);
    }
    if (terms > 1) {
        const double left_length = length_limit(left, terms);
        const double limit =
            (is_square ? left_length * left_length : left_length * length_limit(right, terms)) *
                (1 + (terms + 3) * kRounding) +
            2 * terms * kSmallestNormal;
        if (limit < total.size()) {
            total.low = std::max(total.low, -limit);
            total.high = std::min(total.high, limit);
        }
        if (const auto declared = is_square ? declared_length(left, terms) : std::nullopt) {
            Range to = square(*declared);
            to = tidy({to.low * (1 - 0x1p-20), to.high * (1 + 0x1p-20), to.least * (1 - 0x1p-20), kFinestGrid,
                       to.zero, false});
            total = both(total, to);
        }
    }
    if (is_positive || is_square) total.low = std::max(total.low, 0.0);
    total.grid = std::max(grid, total.grid);
    total.zero = total.low <= 0 && total.high >= 0 && total.zero;
    return rounded(tidy(total));
}

}  // namespace gobo::prove
