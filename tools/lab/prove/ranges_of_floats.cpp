// What each operation on floats makes of what is known of its operands, by the errors that are allowed.
#include <algorithm>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/ranges.hpp"

namespace gobo::prove {
namespace {

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

/// Of a function that never falls, at both ends.
template <class F>
Range rising(const Range& range, const F& f) {
    if (range.has_no_number()) return range;
    return tidy({f(range.low), f(range.high), 0, kFinestGrid, true, range.nan});
}

/// Of numbers that are known to lie between -limit and limit.
Range limited(Range range, double limit) {
    range.low = std::max(range.low, -limit);
    range.high = std::min(range.high, limit);
    return tidy(range);
}

Range root(const Range& range) {
    Range result = rising(range, [](double x) { return std::sqrt(x); });
    result.least = std::sqrt(range.least);
    result.zero = range.holds_zero();
    return rounded(tidy(result));
}

constexpr std::pair<std::uint32_t, double (*)(double)> kRoundings[] = {
    {extended(GLSLstd450Round), [](double x) { return std::round(x); }},
    {extended(GLSLstd450RoundEven), [](double x) { return std::nearbyint(x); }},
    {extended(GLSLstd450Trunc), [](double x) { return std::trunc(x); }},
    {extended(GLSLstd450Floor), [](double x) { return std::floor(x); }},
    {extended(GLSLstd450Ceil), [](double x) { return std::ceil(x); }}};

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

}  // namespace

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
    const auto rising_function = [&](const Range& range, int units, double (*function)(double)) {
        return error(widened(rounded(rising(range, function)), units));
    };
    Range result = kAnything;
    bool nan = false;
    switch (expression.code) {
        case spv::OpFMul:
        case spv::OpVectorTimesScalar:
        case spv::OpMatrixTimesScalar: {
            const bool is_same = expressions_.origin(operands[0]) == expressions_.origin(operands[1]);
            Range real = is_same ? square(both(r[0], r[1])) : product(r[0], r[1]);
            if (makes_unit(&index, 1)) real = limited(real, 1 + kUnitSlack);
            if (const double limit =
                    std::min(cosine_limit(operands[0], operands[1]), cosine_limit(operands[1], operands[0]));
                limit < real.size())
                real = limited(real, limit);
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
            if (divides_by_length(operands, 1, operands[1])) result = limited(result, 1 + kDirectionSlack);
            if (is_at_most(operands[0], operands[1]))
                result = limited(result, error(exactly(1)) == exactly(1) ? 1 : 1 + 0x1p-20);
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
        case extended(GLSLstd450RoundEven):
        case extended(GLSLstd450Trunc):
        case extended(GLSLstd450Floor):
        case extended(GLSLstd450Ceil):
            for (const auto& [code, rounds] : kRoundings)
                if (code == expression.code) result = rising(r[0], rounds);
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
            if (!r[0].has_no_number()) result = error(root(r[0]));
            break;
        case extended(GLSLstd450InverseSqrt):
            if (r[0].low <= 0) {
                nan = true;
                break;
            }
            result = error(widened(rounded(between(1 / std::sqrt(r[0].high), 1 / std::sqrt(r[0].low))), 2));
            break;
        case extended(GLSLstd450Exp):
            result = rising_function(r[0], 2, [](double x) { return std::exp(x); });
            break;
        case extended(GLSLstd450Exp2):
            result = rising_function(r[0], 2, [](double x) { return std::exp2(x); });
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
            result = rising_function(r[0], 4, [](double x) { return std::asinh(x); });
            break;
        case extended(GLSLstd450Sinh):
            result = rising_function(r[0], 4, [](double x) { return std::sinh(x); });
            break;
        case extended(GLSLstd450Cosh): {
            const Range size = size_of(r[0]);
            result = rising_function(size, 4, [](double x) { return std::cosh(x); });
            break;
        }
        case extended(GLSLstd450Acosh):
            nan = r[0].low < 1;
            if (!nan) result = rising_function(r[0], 4, [](double x) { return std::acosh(x); });
            break;
        case extended(GLSLstd450Atanh):
            nan = r[0].size() >= 1;
            if (!nan) result = rising_function(r[0], 4, [](double x) { return std::atanh(x); });
            break;
        case kSumOfProducts:
            result = count == 2 ? rounded(product(r[0], r[1]))
                                : sum_of_products(operands, operands + count / 2, count / 2);
            break;
        case extended(GLSLstd450Length):
            result = error(root(sum_of_products(operands, operands, count)));
            break;
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
            result = rounded(limited(result, limit));
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
    known.of_finite = result;
    known.range = is_wild ? kAnything : result;
    if (is_wild) known.has_product = known.has_product && !known.product.has_no_number();
}

}  // namespace gobo::prove
