// What each operation makes of what is known of its operands: comparisons, ways that meet, and the others by
// what they make. The same formulas as the rows of tools/lab/evaluate, and for each an interval that holds
// the results of all variants.
#include <algorithm>

#include <spirv/unified1/spirv.hpp>

#include "lab/prove/comparison.hpp"
#include "lab/prove/ranges.hpp"

namespace gobo::prove {
namespace {

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
    // Those below 2^-14 may be 0.
    if (range.low >= 0) wider.low = range.low < 0x1p-14 ? 0 : std::max(wider.low, 0.0);
    if (range.high <= 0) wider.high = range.high > -0x1p-14 ? 0 : std::min(wider.high, 0.0);
    return tidy(wider);
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
            const bool is_passed_on = expression.part == 1;
            known.range = also_in_half(whole.range);
            known.makes_infinity =
                is_passed_on
                    ? overflows_half(operands[0])
                    : whole.makes_infinity ||
                          is_infinite(also_in_half(is_infinite(whole.range) ? whole.of_finite : whole.range));
            known.makes_nan = whole.makes_nan && !is_passed_on;
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

bool Ranges::is_half(std::uint32_t expression, int depth) const {
    constexpr int kDeepest = 8;
    expression = expressions_.origin(expression);
    const Expression& one = expressions_.all[expression];
    if (one.code == kHalf) return true;
    if (one.code != kJoined || depth > kDeepest) return false;
    const std::uint32_t* ways = expressions_.operands_of(expression);
    return std::all_of(ways, ways + one.count, [&](std::uint32_t way) { return is_half(way, depth + 1); });
}

bool Ranges::overflows_half(std::uint32_t expression) const {
    return !is_half(expression) && is_infinite(also_in_half(finite_part(known_[expression].range)));
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

}  // namespace gobo::prove
