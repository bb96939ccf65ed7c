// What follows where a condition holds: narrower ranges of its operands, and of what is computed from them.
#include <algorithm>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/comparison.hpp"
#include "lab/prove/ranges.hpp"

namespace gobo::prove {
namespace {

/// Steps that one assumption may take.
constexpr int kMostWork = 4000;

/// All numbers at most or at least so large; NaN stays possible.
Range at_most(double high) {
    return {-kInfinity, high, 0, kFinestGrid, true, true};
}
Range at_least(double low) {
    return {low, kInfinity, 0, kFinestGrid, true, true};
}

}  // namespace

void Ranges::mark_users(std::uint32_t expression) {
    for (const std::uint32_t user : users_[expression]) {
        const Expression& other = expressions_.all[user];
        if (!is_computed_[user] || is_waiting_[user] || other.code == kJoined) continue;
        if (!is_within(expressions_.contexts, frames_.back().context, other.context)) continue;
        is_waiting_[user] = true;
        waiting_.push_back(user);
        std::push_heap(waiting_.begin(), waiting_.end(), std::greater<>());
    }
}

/// Computes again what depends on what has been narrowed. False: nothing reaches this context.
bool Ranges::spread() {
    bool is_possible = true;
    while (!waiting_.empty()) {
        std::pop_heap(waiting_.begin(), waiting_.end(), std::greater<>());
        const std::uint32_t expression = waiting_.back();
        waiting_.pop_back();
        is_waiting_[expression] = false;
        if (!is_possible || ++work_ > kMostWork) continue;
        Known fresh = evaluate(expression);
        const Known& old = known_[expression];
        fresh.range = both(fresh.range, old.range);
        if (fresh.range == old.range) continue;
        saved_.push_back({expression, old});
        known_[expression] = fresh;
        is_possible = !fresh.range.is_empty() && narrow_operands(expression);
        mark_users(expression);
    }
    return is_possible;
}

bool Ranges::narrow(std::uint32_t expression, const Range& to) {
    if (expression >= is_computed_.size() || !is_computed_[expression]) return true;
    Known& known = known_[expression];
    Range narrower = to;
    if (!to.zero && expressions_.all[expression].scalar == Scalar::float32)
        narrower.least = std::max(narrower.least, kSmallestFloat);
    narrower = both(known.range, narrower);
    if (narrower == known.range) return !narrower.is_empty();
    if (narrower.is_empty()) return false;
    saved_.push_back({expression, known});
    known.range = narrower;
    if (++work_ > kMostWork) return true;
    mark_users(expression);
    return narrow_operands(expression);
}

/// What the result says of the operands.
bool Ranges::narrow_operands(std::uint32_t index) {
    const Expression& expression = expressions_.all[index];
    const std::uint32_t* operands = expressions_.operands_of(index);
    const Range& range = known_[index].range;
    switch (expression.code) {
        case kKept:
        case kPlain:
            return narrow(operands[0], range);
        case kJoined: {
            const std::vector<std::uint32_t>& from = expressions_.lists[expression.field];
            std::uint32_t ways = 0;
            std::uint32_t way = 0;
            for (std::uint32_t i = 0; i < expression.count; ++i) {
                if (!is_computed_[operands[i]]) return true;
                if (!reached_[from[i]] || both(known_[operands[i]].range, range).is_empty()) continue;
                ++ways;
                way = i;
            }
            if (ways == 0) return false;
            return ways > 1 ||
                   (narrow(operands[way], range) && assume_context(from[way], expression.context));
        }
        case spv::OpFNegate:
            return narrow(operands[0], negated(range));
        case extended(GLSLstd450FAbs): {
            Range to{-range.high, range.high, range.smallest(), range.grid, range.zero, range.nan};
            return narrow(operands[0], tidy(to));
        }
        case extended(GLSLstd450FMax):
        case extended(GLSLstd450FMin): {
            const bool is_max = expression.code == extended(GLSLstd450FMax);
            const Range to = is_max ? at_most(range.high) : at_least(range.low);
            if (range.nan || known_[operands[0]].range.nan || known_[operands[1]].range.nan) return true;
            for (std::uint32_t i = 0; i < 2; ++i) {
                if (!narrow(operands[i], to)) return false;
                const Range& other = known_[operands[1 - i]].range;
                const bool decides = is_max ? other.high < range.low : other.low > range.high;
                if (decides && !narrow(operands[i], is_max ? at_least(range.low) : at_most(range.high)))
                    return false;
            }
            return true;
        }
        case spv::OpConvertSToF:
            if (range.size() > 0x1p24) return true;
            return narrow(operands[0],
                          {std::ceil(range.low), std::floor(range.high), 1, 0, range.zero, true});
        case spv::OpFMul:
        case spv::OpVectorTimesScalar:
        case spv::OpMatrixTimesScalar:
            // A product that is not 0 has no factor that is.
            if (range.zero || range.nan) return true;
            for (std::uint32_t i = 0; i < 2; ++i) {
                Range to = kAnything;
                to.zero = false;
                if (!narrow(operands[i], to)) return false;
            }
            return true;
        default:
            if (expression.scalar == Scalar::boolean && range.is_one()) return assume(index, range.low != 0);
            return true;
    }
}

bool Ranges::assume(std::uint32_t condition, bool is_true) {
    if (condition >= is_computed_.size() || !is_computed_[condition]) return true;
    const Range to = exactly(is_true ? 1 : 0);
    if (known_[condition].range != to) {
        const Range narrower = both(known_[condition].range, to);
        if (narrower.is_empty()) return false;
        if (narrower != known_[condition].range) {
            saved_.push_back({condition, known_[condition]});
            known_[condition].range = narrower;
            mark_users(condition);
        }
    }
    if (++work_ > kMostWork) return true;
    const Expression& expression = expressions_.all[condition];
    const std::uint32_t* operands = expressions_.operands_of(condition);
    switch (expression.code) {
        case kKept:
        case kPlain:
            return assume(operands[0], is_true);
        case kJoined:
            return narrow_operands(condition);
        case spv::OpLogicalNot:
            return assume(operands[0], !is_true);
        case spv::OpLogicalAnd:
        case spv::OpLogicalOr: {
            const bool is_and = expression.code == spv::OpLogicalAnd;
            if (is_and == is_true) return assume(operands[0], is_true) && assume(operands[1], is_true);
            // One of them decides where the other one is known not to.
            for (std::uint32_t i = 0; i < 2; ++i) {
                const Range& other = known_[operands[1 - i]].range;
                if (other.is_one() && (other.low != 0) == is_and && !assume(operands[i], is_true))
                    return false;
            }
            return true;
        }
        default:
            return assume_comparison(expression, operands, is_true);
    }
}

/// The conditions of a context inside `outer`.
bool Ranges::assume_context(std::uint32_t context, std::uint32_t outer) {
    const auto& contexts = expressions_.contexts;
    if (!is_within(contexts, context, outer)) return true;
    for (; context != outer; context = contexts[context].parent)
        if (!assume(contexts[context].condition, contexts[context].is_true)) return false;
    return true;
}

bool Ranges::assume_comparison(const Expression& comparison, const std::uint32_t* operands, bool is_true) {
    const Comparison* known = comparison_of(comparison.code);
    if (known == nullptr) return true;
    const std::uint32_t a = operands[0];
    const std::uint32_t b = operands[1];
    if (!is_computed_[a] || !is_computed_[b]) return true;
    if (known->is_unsigned && (known_[a].range.low < 0 || known_[b].range.low < 0)) return true;
    const int outcomes = is_true ? known->when_true : kAllOutcomes & ~known->when_true;
    if ((outcomes & kUnordered) != 0 && (known_[a].range.nan || known_[b].range.nan)) return true;
    // From here on neither is NaN.
    Range number = kAnything;
    number.nan = false;
    if (!narrow(a, number) || !narrow(b, number)) return false;
    const auto less = [&](std::uint32_t first, std::uint32_t second, bool is_strict) {
        return assume_order(first, second, is_strict);
    };
    switch (outcomes & ~kUnordered) {
        case kLess:
            return less(a, b, true);
        case kLess | kEqual:
            return less(a, b, false);
        case kGreater:
            return less(b, a, true);
        case kGreater | kEqual:
            return less(b, a, false);
        case kEqual:
            return narrow(a, known_[b].range) && narrow(b, known_[a].range);
        case kLess | kGreater:
            for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
                const Range& fixed = known_[other].range;
                if (!fixed.is_one()) continue;
                const bool is_whole =
                    comparison.scalar != Scalar::float32 && expressions_.all[one].scalar != Scalar::float32;
                Range to = kAnything;
                to.nan = false;
                if (fixed.low == 0) to.zero = false;
                if (known_[one].range.low == fixed.low)
                    to.low = is_whole ? fixed.low + 1 : float_above(fixed.low);
                if (known_[one].range.high == fixed.low)
                    to.high = is_whole ? fixed.low - 1 : float_below(fixed.low);
                if (!narrow(one, to)) return false;
            }
            return true;
        case 0:
            return false;
        default:
            return true;
    }
}

bool Ranges::assume_order(std::uint32_t first, std::uint32_t second, bool is_strict) {
    const bool is_whole = expressions_.all[first].scalar != Scalar::float32;
    orders_.push_back({expressions_.origin(first), expressions_.origin(second), is_strict});
    double high = known_[second].range.high;
    if (is_strict) high = is_whole ? high - 1 : float_below(high);
    if (!narrow(first, at_most(high))) return false;
    double low = known_[first].range.low;
    if (is_strict) low = is_whole ? low + 1 : float_above(low);
    return narrow(second, at_least(low));
}

/// Whether a <= b, or a < b, is among the conditions or follows from two of them.
bool Ranges::is_before(std::uint32_t a, std::uint32_t b, bool& is_strict) const {
    bool is_known = false;
    is_strict = false;
    for (const Order& order : orders_) {
        if (order.first != a) continue;
        if (order.second == b) {
            is_known = true;
            is_strict = is_strict || order.is_strict;
        }
        for (const Order& next : orders_)
            if (next.first == order.second && next.second == b) {
                is_known = true;
                is_strict = is_strict || order.is_strict || next.is_strict;
            }
    }
    return is_known;
}

}  // namespace gobo::prove
