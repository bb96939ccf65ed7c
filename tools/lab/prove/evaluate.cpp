// What each operation makes of what is known of its operands. The same formulas as the rows of
// tools/lab/evaluate, and for each an interval that holds the results of all variants.
#include <algorithm>
#include <bit>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/comparison.hpp"
#include "lab/prove/ranges.hpp"

namespace gobo::prove {
namespace {

constexpr std::uint32_t extended(std::uint32_t number) {
    return evaluate::kExtended + number;
}

#define GOBO_COMPARE(name, outcomes)                                               \
    {spv::OpFOrd##name, outcomes}, {spv::OpFUnord##name, (outcomes) | kUnordered}, \
        {spv::OpS##name, outcomes}, {                                              \
        spv::OpU##name, outcomes, true                                             \
    }

constexpr Comparison kComparisons[] = {
    GOBO_COMPARE(LessThan, kLess),
    GOBO_COMPARE(LessThanEqual, kLess | kEqual),
    GOBO_COMPARE(GreaterThan, kGreater),
    GOBO_COMPARE(GreaterThanEqual, kGreater | kEqual),
    {spv::OpFOrdEqual, kEqual},
    {spv::OpFUnordEqual, kEqual | kUnordered},
    {spv::OpFOrdNotEqual, kLess | kGreater},
    {spv::OpFUnordNotEqual, kLess | kGreater | kUnordered},
    {spv::OpIEqual, kEqual},
    {spv::OpINotEqual, kLess | kGreater},
    {spv::OpLogicalEqual, kEqual},
    {spv::OpLogicalNotEqual, kLess | kGreater},
};

#undef GOBO_COMPARE

/// An operand without what is not finite.
Range finite_part(Range range) {
    range.nan = false;
    range.low = std::max(range.low, -kLargestFloat);
    range.high = std::min(range.high, kLargestFloat);
    return tidy(range);
}

bool is_infinite(const Range& range) {
    return !range.has_no_number() && (range.low < -kLargestFloat || range.high > kLargestFloat);
}

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

/// With the largest error that the specification allows, in both directions.
Range with_error(Range result, std::uint32_t code, const Range& x, const Range& y) {
    const auto row = evaluate::find_row(code);
    if (!row || result.has_no_number() || x.has_no_number()) return result;
    const evaluate::Row& known = evaluate::instruction_table()[*row];
    const auto largest_error = known.liberties.largest_error;
    if (largest_error == nullptr) return result;
    double below = 0;
    double above = 0;
    // Largest at an end or where the specification's formulas change.
    const auto in = [](const Range& range, double number) {
        return std::clamp(number, range.low, range.high);
    };
    constexpr double kPi = 3.14159;
    for (const double a : {x.low, x.high, in(x, 0), in(x, -1), in(x, 1), in(x, -kPi), in(x, kPi)})
        for (const double b : {y.low, y.high, in(y, -1), in(y, 1)}) {
            below = std::max(below, largest_error(a, b, result.low));
            above = std::max(above, largest_error(a, b, result.high));
        }
    // An exponential never falls, nor does it with its error: each end has the error of its own operand.
    if (known.kind == evaluate::Kind::exp) {
        below = largest_error(x.low, 0, result.low);
        above = largest_error(x.high, 0, result.high);
    }
    // Functions that are not negative stay so; angles need not.
    const bool is_positive =
        result.low >= 0 && known.kind != evaluate::Kind::log && known.kind != evaluate::Kind::trig;
    // An error makes no infinity.
    if (std::isfinite(result.high)) result.high = std::min(kLargestFloat, result.high + 2 * above);
    if (std::isfinite(result.low)) result.low = std::max(-kLargestFloat, result.low - 2 * below);
    if (is_positive) result.low = std::max(result.low, 0.0);
    result.low = float_below(result.low);
    result.high =
        std::isfinite(result.high) && result.high < kLargestFloat ? float_above(result.high) : result.high;
    if (is_positive) result.low = std::max(result.low, 0.0);
    result.least = 0;
    result.grid = kFinestGrid;
    result.zero = result.low <= 0 && result.high >= 0;
    return tidy(result);
}

/// As a 16-bit float, or as it was.
Range also_in_half(Range range) {
    if (range.has_no_number()) return range;
    constexpr double kStep = 0x1p-10;
    const auto outwards = [&](double end, bool is_up) {
        const double moved = end + (is_up ? 1 : -1) * (std::fabs(end) * kStep + 0x1p-24);
        return std::fabs(moved) >= 65520 ? (is_up && moved > 0    ? kInfinity
                                            : !is_up && moved < 0 ? -kInfinity
                                                                  : moved)
                                         : moved;
    };
    Range wider{outwards(range.low, false), outwards(range.high, true), 0, kFinestGrid, true, range.nan};
    if (range.low >= 0) wider.low = 0;
    if (range.high <= 0) wider.high = 0;
    return tidy(wider);
}

/// Of a function that never falls, at both ends.
template <class F>
Range rising(const Range& range, const F& f) {
    if (range.has_no_number()) return range;
    return tidy({f(range.low), f(range.high), 0, kFinestGrid, true, range.nan});
}

Range within(double low, double high, bool nan = false) {
    Range range = between(low, high);
    range.nan = nan;
    return range;
}

Range power(const Range& x, const Range& y) {
    const double corners[] = {std::pow(x.low, y.low), std::pow(x.low, y.high), std::pow(x.high, y.low),
                              std::pow(x.high, y.high)};
    const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
    return between(*low, *high);
}

/// The product of one matrix element of each row, and so of any determinant, at most.
double largest_determinant(double size, std::uint32_t elements) {
    if (elements == 4) return 2 * size * size;
    if (elements == 9) return 6 * size * size * size;
    return 24 * size * size * size * size;
}

double truncated(double number) {
    return std::trunc(number);
}

/// 2^k - 1 at least as large.
double all_bits(double number) {
    double bits = 0;
    while (bits < number) bits = 2 * bits + 1;
    return bits;
}

Range wrapped(const Range& range) {
    if (range.low < kAnyInt.low || range.high > kAnyInt.high) return kAnyInt;
    Range whole = range;
    whole.grid = 0;
    whole.nan = false;
    return tidy(whole);
}

}  // namespace

const Comparison* comparison_of(std::uint32_t code) {
    const auto* found = std::ranges::find(kComparisons, code, &Comparison::code);
    return found == std::end(kComparisons) ? nullptr : found;
}

Known Ranges::evaluate(std::uint32_t index) const {
    const Expression& expression = expressions_.all[index];
    const std::uint32_t* operands = expressions_.operands_of(index);
    Known known;
    switch (expression.code) {
        case kUnknown:
        case kConstant:
        case kInput:
        case kTexel:
            known.range = expressions_.known[index];
            return known;
        case kKept:
            return known_[operands[0]];
        case kPlain:
            known.range = known_[operands[0]].range;
            return known;
        case kHalf: {
            const Known& whole = known_[operands[0]];
            known.range = also_in_half(whole.range);
            known.makes_infinity =
                whole.makes_infinity || (!is_infinite(whole.range) && is_infinite(known.range));
            known.makes_nan = whole.makes_nan;
            return known;
        }
        case kJoined:
            evaluate_join(expression, operands, known);
            return known;
        case kIndexed: {
            const std::vector<std::uint32_t>& offsets = expressions_.lists[expression.field];
            const Range& offset = known_[operands[0]].range;
            for (std::uint32_t i = 0; i < offsets.size(); ++i)
                if (offset.low <= offsets[i] && offset.high >= offsets[i])
                    known.range = hull(known.range, known_[operands[i + 1]].range);
            return known;
        }
        case kReplaced: {
            const Range& offset = known_[operands[0]].range;
            known = known_[operands[2]];
            known.makes_infinity = known.makes_nan = false;
            if (offset.low > expression.part || offset.high < expression.part) return known;
            const Range& given = known_[operands[1]].range;
            known.range = offset.is_one() ? given : hull(known.range, given);
            if (offset.is_one()) known.has_product = known.has_terms = false;
            known.always_has_terms = false;
            return known;
        }
        default:
            break;
    }
    if (comparison_of(expression.code) != nullptr) {
        known.range = compare(expression, operands);
        return known;
    }
    if (expression.scalar != Scalar::float32) {
        known.range = evaluate_whole(expression, operands);
        return known;
    }
    evaluate_floats(expression, index, known);
    return known;
}

void Ranges::evaluate_join(const Expression& expression, const std::uint32_t* operands, Known& known) const {
    const std::vector<std::uint32_t>& from = expressions_.lists[expression.field];
    bool is_first = true;
    for (std::uint32_t i = 0; i < expression.count; ++i) {
        if (!reached_[from[i]] || !is_computed_[operands[i]]) continue;
        const Known& way = known_[operands[i]];
        if (is_first) {
            known = way;
            known.makes_infinity = known.makes_nan = false;
            is_first = false;
            continue;
        }
        known.range = hull(known.range, way.range);
        known.product = hull(known.product, way.product);
        for (std::size_t variant = 0; variant < known.terms.size(); ++variant)
            known.terms[variant].add(way.terms[variant]);
        known.has_product = known.has_product || way.has_product;
        known.has_terms = known.has_terms || way.has_terms;
        known.always_has_terms = known.always_has_terms && way.always_has_terms;
    }
}

Range Ranges::compare(const Expression& expression, const std::uint32_t* operands) const {
    const Comparison& comparison = *comparison_of(expression.code);
    const Range& a = known_[operands[0]].range;
    const Range& b = known_[operands[1]].range;
    int outcomes = a.nan || b.nan ? kUnordered : 0;
    if (!a.has_no_number() && !b.has_no_number()) {
        if (comparison.is_unsigned && (a.low < 0 || b.low < 0)) return kTruth;
        if (a.low < b.high) outcomes |= kLess;
        if (a.high > b.low) outcomes |= kGreater;
        Range x = a;
        Range y = b;
        x.nan = y.nan = false;
        if (!both(x, y).is_empty()) outcomes |= kEqual;
        const std::uint32_t first = expressions_.origin(operands[0]);
        const std::uint32_t second = expressions_.origin(operands[1]);
        if (first == second) outcomes &= kEqual | kUnordered;
        bool is_strict = false;
        if (is_before(first, second, is_strict)) outcomes &= is_strict ? kLess : kLess | kEqual;
        if (is_before(second, first, is_strict)) outcomes &= is_strict ? kGreater : kGreater | kEqual;
    }
    const bool may_be_true = (outcomes & comparison.when_true) != 0;
    const bool may_be_false = (outcomes & ~comparison.when_true) != 0;
    if (may_be_true && may_be_false) return kTruth;
    if (!may_be_true && !may_be_false) return kNothing;
    return exactly(may_be_true ? 1 : 0);
}

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

void Ranges::evaluate_floats(const Expression& expression, std::uint32_t index, Known& known) const {
    const std::uint32_t* operands = expressions_.operands_of(index);
    const std::uint32_t count = expression.count;
    const auto raw = [&](std::uint32_t at) -> const Range& { return known_[operands[at]].range; };
    // Operations that pass on what is not finite as it is.
    switch (expression.code) {
        case spv::OpFNegate: {
            known = known_[operands[0]];
            known.makes_infinity = known.makes_nan = false;
            known.range = negated(known.range);
            known.product = negated(known.product);
            for (TermsCases& terms : known.terms) terms.negate();
            if (expression.is_precise) known.has_product = known.has_terms = known.always_has_terms = false;
            return;
        }
        case extended(GLSLstd450FAbs):
            known.range = size_of(raw(0));
            return;
        case extended(GLSLstd450FMin):
        case extended(GLSLstd450NMin):
        case extended(GLSLstd450FMax):
        case extended(GLSLstd450NMax): {
            const bool is_max =
                expression.code == extended(GLSLstd450FMax) || expression.code == extended(GLSLstd450NMax);
            const bool drops =
                expression.code == extended(GLSLstd450NMin) || expression.code == extended(GLSLstd450NMax);
            const Range& a = raw(0);
            const Range& b = raw(1);
            known.range = is_max ? larger(a, b) : smaller(a, b);
            if (a.nan) known.range = hull(known.range, b);
            if (b.nan) known.range = hull(known.range, a);
            known.range.nan = drops ? a.nan && b.nan : a.nan || b.nan;
            return;
        }
        case extended(GLSLstd450FClamp):
        case extended(GLSLstd450NClamp): {
            Range x = raw(0);
            const Range& low = raw(1);
            const Range& high = raw(2);
            const bool nan = x.nan || low.nan || high.nan;
            x.nan = false;
            known.range = nan && x.has_no_number() ? hull(low, high) : smaller(larger(x, low), high);
            if (nan) known.range = hull(known.range, hull(low, high));
            known.range.nan = nan;
            return;
        }
        case extended(GLSLstd450Step): {
            const Range& edge = raw(0);
            const Range& x = raw(1);
            const bool may_be_0 = x.low < edge.high;
            const bool may_be_1 = x.high >= edge.low || x.nan || edge.nan;
            known.range = may_be_0 && may_be_1 ? kTruth : exactly(may_be_1 ? 1 : 0);
            return;
        }
        case extended(GLSLstd450FSign): {
            const Range& x = raw(0);
            Range result{x.low < 0   ? -1.0
                         : x.low > 0 ? 1.0
                                     : 0.0,
                         x.high > 0   ? 1.0
                         : x.high < 0 ? -1.0
                                      : 0.0,
                         1,
                         0,
                         x.holds_zero() || x.nan,
                         false};
            if (x.nan) result = hull(result, exactly(0));
            known.range = tidy(result);
            return;
        }
        case spv::OpFAdd:
        case spv::OpFSub:
            if (raw(0).is_empty() || raw(1).is_empty()) return;
            return evaluate_sum(expression, operands, known);
        default:
            break;
    }
    bool is_wild = false;  // an operand may be NaN or infinite
    std::array<Range, 4> r{};
    for (std::uint32_t at = 0; at < count; ++at) {
        const Range& range = raw(at);
        if (range.is_empty()) return;
        is_wild = is_wild || range.nan || is_infinite(range);
        if (at < r.size()) r[at] = finite_part(range);
        if (range.has_no_number()) {
            known.range = kAnything;
            return;
        }
    }
    const auto error = [&](const Range& result) {
        return with_error(result, expression.code, r[0], count > 1 ? r[1] : exactly(0));
    };
    Range result = kAnything;
    bool nan = false;
    switch (expression.code) {
        case spv::OpFMul:
        case spv::OpVectorTimesScalar:
        case spv::OpMatrixTimesScalar: {
            const bool is_same = expressions_.origin(operands[0]) == expressions_.origin(operands[1]);
            Range real = is_same ? square(both(r[0], r[1])) : product(r[0], r[1]);
            if (makes_unit(&index, 1)) {
                real.low = std::max(real.low, -1 - kUnitSlack);
                real.high = std::min(real.high, 1 + kUnitSlack);
                real = tidy(real);
            }
            if (const double limit =
                    std::min(cosine_limit(operands[0], operands[1]), cosine_limit(operands[1], operands[0]));
                limit < real.size()) {
                real.low = std::max(real.low, -limit);
                real.high = std::min(real.high, limit);
                real = tidy(real);
            }
            result = rounded(real);
            known.has_product = !expression.is_precise;
            known.product = real;
            break;
        }
        case spv::OpFDiv:
            if (r[1].holds_zero()) {
                nan = true;
                break;
            }
            result = error(rounded(quotient(r[0], r[1])));
            if (const double limit = sine_limit(operands[0], operands[1]); limit < result.high) {
                result.high = std::max(limit, 0.0);
                result = tidy(result);
            }
            if (divides_by_length(operands, 1, operands[1])) {
                result.low = std::max(result.low, -1 - kDirectionSlack);
                result.high = std::min(result.high, 1 + kDirectionSlack);
                result = tidy(result);
            }
            if (is_at_most(operands[0], operands[1])) {
                constexpr double kMost = 1 + 0x1p-20;
                const bool is_exact = error(exactly(1)) == exactly(1);
                result.low = std::max(result.low, is_exact ? -1 : -kMost);
                result.high = std::min(result.high, is_exact ? 1 : kMost);
                result = tidy(result);
            }
            break;
        case spv::OpFMod:
        case spv::OpFRem:
            if (r[1].holds_zero()) {
                nan = true;
                break;
            }
            // The quotient may overflow or lose its digits: then the result is anything up to the dividend's
            // rounding.
            if (expression.code == spv::OpFRem)
                result = within(-std::min(r[0].size(), r[1].size()), std::min(r[0].size(), r[1].size()));
            else if (quotient(r[0], r[1]).size() < 0x1p20) {
                const double slack = 4 * kRounding * (r[0].size() + r[1].size());
                result = within(r[1].low < 0 ? r[1].low - slack : -slack,
                                r[1].high > 0 ? r[1].high + slack : slack);
                result = widened(rounded(result), 1);
            }
            break;
        case extended(GLSLstd450Round):
            result = rising(r[0], [](double x) { return std::round(x); });
            result.grid = 0;
            break;
        case extended(GLSLstd450RoundEven):
            result = rising(r[0], [](double x) { return std::nearbyint(x); });
            result.grid = 0;
            break;
        case extended(GLSLstd450Trunc):
            result = rising(r[0], [](double x) { return std::trunc(x); });
            result.grid = 0;
            break;
        case extended(GLSLstd450Floor):
            result = rising(r[0], [](double x) { return std::floor(x); });
            result.grid = 0;
            break;
        case extended(GLSLstd450Ceil):
            result = rising(r[0], [](double x) { return std::ceil(x); });
            result.grid = 0;
            break;
        case extended(GLSLstd450Fract):
            result = within(0, 1);
            break;
        case extended(GLSLstd450FMix): {
            const Range rest = rounded(sum(exactly(1), negated(r[2])));
            const Range from = rounded(product(r[0], rest));
            const Range to = rounded(product(r[1], r[2]));
            result = rounded(sum(from, to));
            result = hull(result, rounded(sum(product(r[0], rest), to)));
            break;
        }
        case extended(GLSLstd450SmoothStep):
            // The formula's rounding passes 1 by little.
            result = within(0, 1 + 0x1p-20);
            nan = !both(r[0], r[1]).is_empty() ||
                  std::max({r[0].size(), r[1].size(), r[2].size()}) > kLargestFloat / 4;
            break;
        case extended(GLSLstd450Fma):
            result = rounded(sum(product(r[0], r[1]), r[2]));
            break;
        case extended(GLSLstd450Sqrt):
            nan = r[0].low < 0;
            r[0].low = std::max(r[0].low, 0.0);
            r[0] = tidy(r[0]);
            if (!r[0].has_no_number()) {
                result = rising(r[0], [](double x) { return std::sqrt(x); });
                result.least = std::sqrt(r[0].least);
                result.zero = r[0].holds_zero();
                result = error(rounded(tidy(result)));
            }
            break;
        case extended(GLSLstd450InverseSqrt):
            if (r[0].low <= 0) {
                nan = true;
                break;
            }
            result = error(widened(rounded(between(1 / std::sqrt(r[0].high), 1 / std::sqrt(r[0].low))), 2));
            break;
        case extended(GLSLstd450Exp):
            result = error(widened(rounded(rising(r[0], [](double x) { return std::exp(x); })), 2));
            break;
        case extended(GLSLstd450Exp2):
            result = error(widened(rounded(rising(r[0], [](double x) { return std::exp2(x); })), 2));
            break;
        case extended(GLSLstd450Log):
        case extended(GLSLstd450Log2):
            if (r[0].low <= 0) {
                nan = true;
                break;
            }
            result = rising(
                r[0], expression.code == extended(GLSLstd450Log) ? [](double x) { return std::log(x); }
                                                                 : [](double x) { return std::log2(x); });
            // Near 1 the error is an absolute one.
            result = error(
                widened(rounded(widened_by(result, r[0].high > 0.4 && r[0].low < 2.1 ? 0x1p-21 : 0)), 2));
            break;
        case extended(GLSLstd450Pow):
            if (r[0].low < 0 || (r[0].holds_zero() && r[1].low <= 0)) {
                nan = true;
                break;
            }
            result = error(widened(rounded(power(r[0], r[1])), 2));
            break;
        case extended(GLSLstd450Radians):
        case extended(GLSLstd450Degrees):
            result = widened(rounded(product(r[0], exactly(expression.code == extended(GLSLstd450Radians)
                                                               ? 0.017453292519943295
                                                               : 57.29577951308232))),
                             2);
            break;
        case extended(GLSLstd450Sin):
        case extended(GLSLstd450Cos):
        case extended(GLSLstd450Tanh):
            result = error(within(-1, 1));
            break;
        case extended(GLSLstd450Asin):
        case extended(GLSLstd450Atan):
            nan = expression.code == extended(GLSLstd450Asin) && r[0].size() > 1;
            result = error(within(-1.5707965, 1.5707965));
            break;
        case extended(GLSLstd450Acos):
            nan = r[0].size() > 1;
            result = error(within(0, 3.1415930));
            break;
        case extended(GLSLstd450Atan2):
            result = error(within(-3.1415930, 3.1415930));
            break;
        case extended(GLSLstd450Asinh):
            result = error(widened(rounded(rising(r[0], [](double x) { return std::asinh(x); })), 4));
            break;
        case extended(GLSLstd450Sinh):
            result = error(widened(rounded(rising(r[0], [](double x) { return std::sinh(x); })), 4));
            break;
        case extended(GLSLstd450Cosh): {
            const Range size = size_of(r[0]);
            result = error(widened(rounded(rising(size, [](double x) { return std::cosh(x); })), 4));
            break;
        }
        case extended(GLSLstd450Acosh):
            nan = r[0].low < 1;
            if (!nan)
                result = error(widened(rounded(rising(r[0], [](double x) { return std::acosh(x); })), 4));
            break;
        case extended(GLSLstd450Atanh):
            nan = r[0].size() >= 1;
            if (!nan)
                result = error(widened(rounded(rising(r[0], [](double x) { return std::atanh(x); })), 4));
            break;
        case kSumOfProducts:
            result = count == 2 ? rounded(product(r[0], r[1]))
                                : sum_of_products(operands, operands + count / 2, count / 2);
            break;
        case extended(GLSLstd450Length): {
            const Range of_squares = sum_of_products(operands, operands, count);
            result = rising(of_squares, [](double x) { return std::sqrt(x); });
            result.least = std::sqrt(of_squares.least);
            result.zero = of_squares.holds_zero();
            result = error(rounded(tidy(result)));
            break;
        }
        case extended(GLSLstd450Distance): {
            double square = 0;
            for (std::uint32_t i = 0; i < count / 2; ++i) {
                const double size = sum(finite_part(raw(i)), negated(finite_part(raw(i + count / 2)))).size();
                square += size * size;
            }
            if (square < kLargestFloat * 0.999)
                result = error(widened(rounded(within(0, std::sqrt(square))), 4));
            break;
        }
        case extended(GLSLstd450Normalize): {
            const Range of_squares = sum_of_products(operands, operands, count);
            nan = of_squares.low <= 0 && of_squares.holds_zero();
            // What has lost no digits is at most 1.
            if (of_squares.least > 1e-30 && !is_infinite(of_squares))
                result = within(-1 - kDirectionSlack, 1 + kDirectionSlack);
            break;
        }
        case extended(GLSLstd450Cross): {
            const std::uint32_t next = (expression.part + 1) % 3;
            const std::uint32_t last = (expression.part + 2) % 3;
            const Range first = product(finite_part(raw(next)), finite_part(raw(3 + last)));
            const Range second = product(finite_part(raw(3 + next)), finite_part(raw(last)));
            result = sum(first, negated(second));
            const int grid = result.grid;
            result = widened_by(result, 3 * kRounding * (first.size() + second.size()) + 2 * kSmallestNormal);
            const double limit =
                length_limit(operands, 3) * length_limit(operands + 3, 3) * (1 + 8 * kRounding) +
                4 * kSmallestNormal;
            result.low = std::max(result.low, -limit);
            result.high = std::min(result.high, limit);
            result.grid = std::max(grid, kFinestGrid);
            result = rounded(tidy(result));
            break;
        }
        case extended(GLSLstd450Reflect): {
            const std::uint32_t size = count / 2;
            const Range along = sum_of_products(operands + size, operands, size);
            const Range incident = finite_part(raw(expression.part));
            const Range turned =
                product(product(exactly(-2), along), finite_part(raw(size + expression.part)));
            result = widened_by(sum(incident, turned),
                                4 * kRounding * (incident.size() + turned.size()) + 4 * kSmallestNormal);
            const double normal = length_limit(operands + size, size);
            const double ray = length_limit(operands, size);
            const double limit =
                ray * std::sqrt(1 + 4 * normal * normal * std::max(0.0, normal * normal - 1)) +
                0x1p-21 * ray * (1 + 2 * normal * normal) + 8 * kSmallestNormal;
            if (limit < kInfinity) {
                result.low = std::max(result.low, -limit);
                result.high = std::min(result.high, limit);
            }
            result = rounded(tidy(result));
            break;
        }
        case extended(GLSLstd450FaceForward): {
            const Range normal = finite_part(raw(expression.part));
            result = hull(normal, negated(normal));
            break;
        }
        case extended(GLSLstd450Determinant): {
            double size = 0;
            for (std::uint32_t at = 0; at < count; ++at) size = std::max(size, finite_part(raw(at)).size());
            const double most = largest_determinant(size, count) * (1 + 1e-5) + 64 * kSmallestNormal;
            result = rounded(within(-most, most));
            // Products of parts overflow where the whole may.
            break;
        }
        case spv::OpConvertSToF:
            result = rounded(r[0]);
            break;
        case spv::OpConvertUToF:
            result = r[0].low < 0 ? rounded(whole_between(0, 4294967295.0)) : rounded(r[0]);
            break;
        case spv::OpDPdx:
        case spv::OpDPdy:
        case spv::OpDPdxFine:
        case spv::OpDPdyFine:
        case spv::OpDPdxCoarse:
        case spv::OpDPdyCoarse:
        case spv::OpFwidth:
        case spv::OpFwidthFine:
        case spv::OpFwidthCoarse: {
            const Range here = across_pixels(operands[0]);
            if (!here.is_finite()) {
                nan = true;
                break;
            }
            const Range change = rounded(sum(here, negated(here)));
            const bool is_width = expression.code == spv::OpFwidth || expression.code == spv::OpFwidthFine ||
                                  expression.code == spv::OpFwidthCoarse;
            result = is_width ? rounded(within(0, 2 * change.size())) : change;
            break;
        }
        case extended(GLSLstd450InterpolateAtCentroid):
        case extended(GLSLstd450InterpolateAtSample):
            result = across_pixels(operands[0]);
            break;
        case extended(GLSLstd450UnpackSnorm4x8):
        case extended(GLSLstd450UnpackSnorm2x16):
            result = within(-1, 1);
            break;
        case extended(GLSLstd450UnpackUnorm4x8):
        case extended(GLSLstd450UnpackUnorm2x16):
            result = within(0, 1);
            break;
        case extended(GLSLstd450FrexpStruct):
            result = within(-1, 1);
            break;
        case extended(GLSLstd450ModfStruct):
            // First the fractions, then the whole parts.
            if (expression.part == 0)
                result = within(-1, 1);
            else
                result = rising(r[0], truncated);
            break;
        default:
            nan = true;
            break;
    }
    result = tidy(result);
    known.makes_infinity = is_infinite(result) && expression.code != extended(GLSLstd450UnpackHalf2x16) &&
                           expression.code != spv::OpBitcast;
    known.makes_nan = nan;
    result.nan = result.nan || nan;
    known.range = is_wild ? kAnything : result;
    if (is_wild) known.has_product = known.has_product && !known.product.has_no_number();
}

Range Ranges::evaluate_whole(const Expression& expression, const std::uint32_t* operands) const {
    std::array<Range, 4> r{};
    for (std::uint32_t at = 0; at < expression.count; ++at) {
        const Range& range = known_[operands[at]].range;
        if (range.is_empty()) return kNothing;
        if (at >= r.size()) continue;
        r[at] = range;
        if (expressions_.all[operands[at]].scalar == Scalar::float32) continue;
        r[at].nan = false;
        r[at] = both(r[at], kAnyInt);
    }
    const bool is_truth = expression.scalar == Scalar::boolean;
    const bool are_positive = r[0].low >= 0 && (expression.count < 2 || r[1].low >= 0);
    const auto truth = [](bool may_be_true, bool may_be_false) {
        return may_be_true && may_be_false ? kTruth : exactly(may_be_true ? 1 : 0);
    };
    switch (expression.code) {
        case spv::OpLogicalAnd:
            return truth(r[0].high > 0 && r[1].high > 0, r[0].low == 0 || r[1].low == 0);
        case spv::OpLogicalOr:
            return truth(r[0].high > 0 || r[1].high > 0, r[0].low == 0 && r[1].low == 0);
        case spv::OpLogicalNot:
            return truth(r[0].low == 0, r[0].high > 0);
        case spv::OpIsNan:
            return truth(r[0].nan, !r[0].has_no_number());
        case spv::OpIsInf:
            return truth(is_infinite(r[0]), true);
        case spv::OpIAdd:
            return wrapped(sum(r[0], r[1]));
        case spv::OpISub:
            return wrapped(sum(r[0], negated(r[1])));
        case spv::OpIMul:
            return wrapped(product(r[0], r[1]));
        case spv::OpSNegate:
            return wrapped(negated(r[0]));
        case extended(GLSLstd450SAbs):
            return wrapped(size_of(r[0]));
        case extended(GLSLstd450SSign):
            return tidy({r[0].low < 0   ? -1.0
                         : r[0].low > 0 ? 1.0
                                        : 0.0,
                         r[0].high > 0   ? 1.0
                         : r[0].high < 0 ? -1.0
                                         : 0.0,
                         1, 0, true, false});
        case spv::OpUDiv:
            if (!are_positive && r[1].low >= 2) return whole_between(0, std::floor(kAnyUint.high / r[1].low));
            if (!are_positive || r[1].holds_zero()) return kAnyInt;
            [[fallthrough]];
        case spv::OpSDiv: {
            if (r[1].holds_zero() || r[1].low < 0) return wrapped(within(-r[0].size(), r[0].size()));
            Range result = quotient(r[0], r[1]);
            return wrapped(tidy({std::trunc(result.low), std::trunc(result.high), 1, 0, true, false}));
        }
        case spv::OpUMod:
            if (!are_positive && r[1].low > 0) return whole_between(0, r[1].high - 1);
            if (!are_positive || r[1].holds_zero()) return kAnyInt;
            [[fallthrough]];
        case spv::OpSRem:
        case spv::OpSMod: {
            if (r[0].is_one() && r[1].is_one() && r[0].low >= 0 && r[1].low > 0)
                return exactly(std::fmod(r[0].low, r[1].low));
            const double most = std::max(0.0, r[1].size() - 1);
            if (expression.code == spv::OpSMod)
                return wrapped(whole_between(r[1].low < 0 ? -most : 0, r[1].high > 0 ? most : 0));
            return wrapped(
                whole_between(r[0].low < 0 ? -most : 0, r[0].high > 0 ? std::min(most, r[0].high) : 0));
        }
        case spv::OpBitwiseAnd:
            if (r[0].is_one() && r[1].is_one())
                return exactly(static_cast<std::int32_t>(static_cast<std::int64_t>(r[0].low) &
                                                         static_cast<std::int64_t>(r[1].low)));
            if (r[0].low >= 0 && r[1].low >= 0) return whole_between(0, std::min(r[0].high, r[1].high));
            if (r[0].low >= 0) return whole_between(0, r[0].high);
            if (r[1].low >= 0) return whole_between(0, r[1].high);
            return kAnyInt;
        case spv::OpBitwiseOr:
        case spv::OpBitwiseXor: {
            const auto a = static_cast<std::int64_t>(r[0].low);
            const auto b = static_cast<std::int64_t>(r[1].low);
            if (r[0].is_one() && r[1].is_one())
                return exactly(static_cast<double>(expression.code == spv::OpBitwiseOr ? a | b : a ^ b));
            return are_positive ? whole_between(0, all_bits(std::max(r[0].high, r[1].high))) : kAnyInt;
        }
        case spv::OpNot:
            return wrapped(sum(negated(r[0]), exactly(-1)));
        case spv::OpShiftRightLogical:
            if (r[0].low < 0 && r[1].is_one() && r[1].low >= 1 && r[1].low <= 31)
                return whole_between(0, std::ldexp(1.0, 32 - static_cast<int>(r[1].low)) - 1);
            if (r[0].low < 0) return kAnyInt;
            [[fallthrough]];
        case spv::OpShiftRightArithmetic:
            if (!r[1].is_one() || r[1].low < 0 || r[1].low > 31)
                return r[0].low >= 0 ? whole_between(0, r[0].high) : kAnyInt;
            return tidy({std::floor(std::ldexp(r[0].low, -static_cast<int>(r[1].low))),
                         std::floor(std::ldexp(r[0].high, -static_cast<int>(r[1].low))), 1, 0, true, false});
        case spv::OpShiftLeftLogical:
            if (!r[1].is_one() || r[1].low < 0 || r[1].low > 31) return kAnyInt;
            return wrapped(tidy({std::ldexp(r[0].low, static_cast<int>(r[1].low)),
                                 std::ldexp(r[0].high, static_cast<int>(r[1].low)), 1, 0, true, false}));
        case spv::OpBitCount:
            return whole_between(0, 32);
        case extended(GLSLstd450FindILsb):
        case extended(GLSLstd450FindSMsb):
        case extended(GLSLstd450FindUMsb):
            return whole_between(-1, 31);
        case extended(GLSLstd450UMin):
        case extended(GLSLstd450SMin):
            if (expression.code == extended(GLSLstd450UMin) && !are_positive) {
                if (r[0].low < 0 && r[1].low < 0) return kAnyInt;
                return whole_between(0, r[0].low >= 0 ? r[0].high : r[1].high);
            }
            return smaller(r[0], r[1]);
        case extended(GLSLstd450UMax):
        case extended(GLSLstd450SMax):
            if (expression.code == extended(GLSLstd450UMax) && !are_positive) return kAnyInt;
            return larger(r[0], r[1]);
        case extended(GLSLstd450UClamp):
        case extended(GLSLstd450SClamp):
            if (expression.code == extended(GLSLstd450UClamp) && (!are_positive || r[2].low < 0))
                return kAnyInt;
            return smaller(larger(r[0], r[1]), r[2]);
        case spv::OpConvertFToS: {
            if (r[0].has_no_number()) return exactly(0);
            Range result{std::clamp(std::trunc(r[0].low), kAnyInt.low, kAnyInt.high),
                         std::clamp(std::trunc(r[0].high), kAnyInt.low, kAnyInt.high),
                         1,
                         0,
                         true,
                         false};
            return r[0].nan ? hull(tidy(result), exactly(0)) : tidy(result);
        }
        case spv::OpConvertFToU:
            if (r[0].nan || r[0].high > kAnyInt.high) return kAnyInt;
            return whole_between(std::max(0.0, std::trunc(r[0].low)), std::max(0.0, std::trunc(r[0].high)));
        case spv::OpBitcast:
        case spv::OpUConvert:
        case spv::OpSConvert:
        case spv::OpCopyObject:
            return expressions_.all[operands[0]].scalar == Scalar::float32 ? kAnyInt : r[0];
        default:
            return is_truth ? kTruth : kAnyInt;
    }
}

}  // namespace gobo::prove
