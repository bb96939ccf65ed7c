#include "lab/prove/ranges.hpp"

#include <algorithm>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/prove/comparison.hpp"

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

std::uint32_t common_context(const std::vector<Context>& contexts, std::uint32_t a, std::uint32_t b) {
    while (a != b) {
        if (contexts[a].depth < contexts[b].depth) std::swap(a, b);
        a = contexts[a].parent;
    }
    return a;
}

bool is_within(const std::vector<Context>& contexts, std::uint32_t inner, std::uint32_t outer) {
    while (contexts[inner].depth > contexts[outer].depth) inner = contexts[inner].parent;
    return inner == outer;
}

void Ranges::grow() {
    const std::size_t count = expressions_.all.size();
    const std::size_t before = users_.size();
    if (before == count) return;
    known_.resize(count);
    whole_.resize(count, kNothing);
    is_computed_.resize(count, false);
    is_waiting_.resize(count, false);
    cut_of_.resize(count, -1);
    users_.resize(count);
    for (std::size_t index = before; index < count; ++index)
        for (std::uint32_t at = 0; at < expressions_.all[index].count; ++at) {
            std::vector<std::uint32_t>& users =
                users_[expressions_.operand(static_cast<std::uint32_t>(index), at)];
            if (users.empty() || users.back() != index) users.push_back(static_cast<std::uint32_t>(index));
        }
}

void Ranges::begin(const std::vector<Cut>& cuts, const std::vector<bool>* is_wanted) {
    grow();
    wanted_ = is_wanted;
    std::fill(is_computed_.begin(), is_computed_.end(), false);
    for (const Cut& cut : cuts_) cut_of_[cut.expression] = -1;
    cuts_ = cuts;
    // Several cuts of one expression count together.
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
        std::int32_t& index = cut_of_[cuts_[i].expression];
        if (index >= 0)
            cuts_[static_cast<std::size_t>(index)].range =
                both(cuts_[static_cast<std::size_t>(index)].range, cuts_[i].range);
        else
            index = static_cast<std::int32_t>(i);
    }
    frames_ = {{0, 0, 0, true}};
    saved_.clear();
    orders_.clear();
    reached_.assign(expressions_.contexts.size(), false);
    reached_[0] = true;
    is_reached_ = true;
}

void Ranges::compute(std::uint32_t expression) {
    grow();
    Known& known = known_[expression];
    is_computed_[expression] = true;
    if (!is_reached_) {
        known = {};
        return;
    }
    known = evaluate(expression);
    if (const std::int32_t cut = cut_of_[expression]; cut >= 0)
        known.range = both(known.range, cuts_[static_cast<std::size_t>(cut)].range);
    if (cuts_.empty() && frames_.back().context == 0) whole_[expression] = known.range;
    if (!known.range.is_empty()) return;
    is_reached_ = false;
    reached_[frames_.back().context] = false;
}

Range Ranges::across_pixels(std::uint32_t expression) const {
    if (expressions_.all[expression].code == kConstant) return known_[expression].range;
    return whole_[expression].is_empty() ? kAnything : whole_[expression];
}

void Ranges::enter(std::uint32_t context) {
    if (reached_.size() < expressions_.contexts.size()) reached_.resize(expressions_.contexts.size(), false);
    const std::uint32_t current = frames_.back().context;
    if (current == context) return;
    leave_to(common_context(expressions_.contexts, current, context));
    push(context);
}

void Ranges::leave_to(std::uint32_t context) {
    while (frames_.back().context != context) {
        const Frame frame = frames_.back();
        frames_.pop_back();
        while (saved_.size() > frame.saved) {
            known_[saved_.back().expression] = saved_.back().known;
            saved_.pop_back();
        }
        orders_.resize(frame.orders);
        is_reached_ = frame.was_reached;
    }
    is_reached_ = is_reached_ && reached_[context];
}

void Ranges::push(std::uint32_t context) {
    if (frames_.back().context == context) return;
    const Context& entered = expressions_.contexts[context];
    push(entered.parent);
    frames_.push_back({context, saved_.size(), orders_.size(), is_reached_});
    work_ = 0;
    if (is_reached_) is_reached_ = assume(entered.condition, entered.is_true) && spread();
    reached_[context] = is_reached_;
}

bool Ranges::excludes(const std::vector<Cut>& assumptions) {
    if (!is_reached_) return true;
    const std::size_t saved = saved_.size();
    const std::size_t orders = orders_.size();
    work_ = 0;
    bool is_possible = true;
    for (const Cut& assumption : assumptions)
        is_possible = is_possible && narrow(assumption.expression, assumption.range);
    is_possible = is_possible && spread();
    for (const std::uint32_t waiting : waiting_) is_waiting_[waiting] = false;
    waiting_.clear();
    while (saved_.size() > saved) {
        known_[saved_.back().expression] = saved_.back().known;
        saved_.pop_back();
    }
    orders_.resize(orders);
    return !is_possible;
}

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

std::optional<Range> Ranges::declared_length(const std::uint32_t* vector, std::uint32_t count) const {
    const Expression& first = expressions_.all[expressions_.origin(vector[0])];
    if (first.code != kInput) return std::nullopt;
    const sanitize::InputField& field = space_.fields[first.field];
    if (!field.domain.of_length || count != field.ranged()) return std::nullopt;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Expression& one = expressions_.all[expressions_.origin(vector[i])];
        if (one.code != kInput || one.field != first.field || one.part != i) return std::nullopt;
    }
    // Components are rounded to floats after the vector has been given its length.
    constexpr double kSlack = 0x1p-22;
    Range range{
        field.domain.low * (1 - kSlack), field.domain.high * (1 + kSlack), 0, kFinestGrid, false, false};
    range.least = range.low;
    range.zero = range.low <= 0;
    for (const double also : field.domain.also) {
        range.low = std::min(range.low, also);
        range.high = std::max(range.high, also);
        range.least = also == 0 ? range.least : std::min(range.least, also);
        range.zero = range.zero || also == 0;
    }
    return tidy(range);
}

double Ranges::length_limit(const std::uint32_t* vector, std::uint32_t count, int depth) const {
    constexpr int kDeepest = 12;
    double square = 0;
    std::array<std::uint32_t, 4> origins{};
    if (count > origins.size()) return kInfinity;
    for (std::uint32_t i = 0; i < count; ++i) {
        origins[i] = expressions_.origin(vector[i]);
        const Range& range = known_[vector[i]].range;
        if (range.nan) return kInfinity;
        square += range.has_no_number() ? 0 : range.size() * range.size();
    }
    const double by_components = std::sqrt(square) * (1 + 1e-12);
    if (depth > kDeepest || expressions_.has_relaxed) return by_components;
    const Expression& first = expressions_.all[origins[0]];
    for (std::uint32_t i = 1; i < count; ++i) {
        const Expression& other = expressions_.all[origins[i]];
        if (other.code != first.code || other.count != first.count) return by_components;
    }
    if (const auto declared = declared_length(vector, count)) return std::min(by_components, declared->high);
    constexpr double kStep = 1 + 0x1p-22;
    // The same operand of each component.
    std::array<std::uint32_t, 4> parts{};
    const auto limit_of = [&](std::uint32_t operand) {
        for (std::uint32_t i = 0; i < count; ++i) parts[i] = expressions_.operand(origins[i], operand);
        return length_limit(parts.data(), count, depth + 1);
    };
    const auto shares = [&](std::uint32_t operand) {
        for (std::uint32_t i = 1; i < count; ++i)
            if (expressions_.origin(expressions_.operand(origins[i], operand)) !=
                expressions_.origin(expressions_.operand(origins[0], operand)))
                return false;
        return true;
    };
    const std::uint32_t* operands = expressions_.operands_of(origins[0]);
    double limit = by_components;
    switch (first.code) {
        case spv::OpFNegate:
            limit = limit_of(0);
            break;
        case spv::OpFAdd:
        case spv::OpFSub:
            limit = (limit_of(0) + limit_of(1)) * kStep;
            break;
        case spv::OpFMul:
        case spv::OpVectorTimesScalar:
            if (shares(1)) {
                if (makes_unit(origins.data(), count)) return std::min(by_components, 1 + kUnitSlack);
                limit = limit_of(0) * known_[operands[1]].range.size() * kStep;
            } else if (shares(0)) {
                limit = limit_of(1) * known_[operands[0]].range.size() * kStep;
            }
            break;
        case spv::OpFDiv:
            if (!shares(1)) break;
            for (std::uint32_t i = 0; i < count; ++i) parts[i] = expressions_.operand(origins[i], 0);
            if (divides_by_length(parts.data(), count, operands[1]))
                return std::min(by_components, 1 + kDirectionSlack);
            limit = limit_of(0) / std::max(known_[operands[1]].range.smallest(), kSmallestFloat) * kStep;
            break;
        case kJoined: {
            const std::vector<std::uint32_t>& from = expressions_.lists[first.field];
            for (std::uint32_t i = 1; i < count; ++i)
                if (expressions_.all[origins[i]].field != first.field) return by_components;
            limit = 0;
            for (std::uint32_t way = 0; way < first.count; ++way)
                if (reached_[from[way]]) limit = std::max(limit, limit_of(way));
            break;
        }
        case extended(GLSLstd450Normalize):
            if (count == first.count && known_[origins[0]].range.size() < 2) limit = 1 + kDirectionSlack;
            break;
        case extended(GLSLstd450Cross):
            limit = length_limit(operands, 3, depth + 1) * length_limit(operands + 3, 3, depth + 1) *
                    (1 + 4 * kStep - 4);
            break;
        case extended(GLSLstd450Reflect): {
            const double incident = length_limit(operands, count, depth + 1);
            const double normal = length_limit(operands + count, count, depth + 1);
            if (2 * count != first.count) break;
            limit = incident * std::sqrt(1 + 4 * normal * normal * std::max(0.0, normal * normal - 1)) +
                    0x1p-21 * incident * (1 + 2 * normal * normal);
            break;
        }
        default:
            break;
    }
    return std::isnan(limit) ? by_components : std::min(limit, by_components);
}

bool Ranges::makes_unit(const std::uint32_t* products, std::uint32_t count) const {
    if (expressions_.has_relaxed) return false;
    // v * inversesqrt(max(dot(v, v), least)), or without max().
    const std::uint32_t root = expressions_.origin(expressions_.operand(products[0], 1));
    if (expressions_.all[root].code != extended(GLSLstd450InverseSqrt)) return false;
    const std::uint32_t under_root = expressions_.operand(root, 0);
    if (known_[under_root].range.low < 1e-31 || known_[under_root].range.nan) return false;
    const auto is_square_of_all = [&](std::uint32_t candidate) {
        candidate = expressions_.origin(candidate);
        const Expression& sum = expressions_.all[candidate];
        if (sum.code != kSumOfProducts) return false;
        const std::uint32_t terms = sum.count / 2;
        for (std::uint32_t i = 0; i < terms; ++i)
            if (expressions_.origin(expressions_.operand(candidate, i)) !=
                expressions_.origin(expressions_.operand(candidate, terms + i)))
                return false;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t factor = expressions_.origin(expressions_.operand(products[i], 0));
            bool is_among = false;
            for (std::uint32_t k = 0; k < terms; ++k) {
                // Each component once.
                const bool is_this = expressions_.origin(expressions_.operand(candidate, k)) == factor;
                is_among = is_among || (is_this && (count == 1 || k == i));
            }
            if (!is_among) return false;
        }
        return true;
    };
    const std::uint32_t origin = expressions_.origin(under_root);
    if (expressions_.all[origin].code == extended(GLSLstd450FMax))
        return is_square_of_all(expressions_.operand(origin, 0)) ||
               is_square_of_all(expressions_.operand(origin, 1));
    return is_square_of_all(origin);
}

bool Ranges::is_at_most(std::uint32_t a, std::uint32_t b, int depth) const {
    constexpr int kDeepest = 8;
    const Range& range = known_[a].range;
    if (range.nan || known_[b].range.nan) return false;
    if (range.size() <= known_[b].range.low) return true;
    a = expressions_.origin(a);
    b = expressions_.origin(b);
    if (a == b && range.low >= 0) return true;
    bool is_strict = false;
    if (range.low >= 0 && is_before(a, b, is_strict)) return true;
    if (depth > kDeepest) return false;
    const Expression& larger = expressions_.all[b];
    const std::uint32_t* operands = expressions_.operands_of(b);
    if (larger.code == extended(GLSLstd450FAbs)) {
        const std::uint32_t inner = expressions_.origin(operands[0]);
        if (inner == a) return true;
        const Expression& also = expressions_.all[a];
        if (also.code == extended(GLSLstd450FAbs) && expressions_.origin(expressions_.operand(a, 0)) == inner)
            return true;
    }
    // a - c <= a - b where b <= c, both sums of nothing that a variant of arithmetic would regroup.
    const Expression& smaller = expressions_.all[a];
    if (larger.code == spv::OpFSub && smaller.code == spv::OpFSub && range.low >= 0) {
        const std::uint32_t* others = expressions_.operands_of(a);
        const std::uint32_t from = expressions_.origin(operands[0]);
        const auto is_plain = [&](std::uint32_t one) {
            return !known_[one].has_product && !known_[one].has_terms;
        };
        if (expressions_.origin(others[0]) == from && is_plain(others[0]) && is_plain(others[1]) &&
            is_plain(operands[1]) &&
            (expressions_.origin(operands[1]) == expressions_.origin(others[1]) ||
             is_before(expressions_.origin(operands[1]), expressions_.origin(others[1]), is_strict)))
            return true;
    }
    // a <= a + c where c is not negative, however sums are regrouped, if c is none.
    if (larger.code == spv::OpFAdd && range.low >= 0)
        for (std::uint32_t i = 0; i < 2; ++i) {
            const Known& other = known_[operands[1 - i]];
            if (expressions_.origin(operands[i]) == a && other.range.low >= 0 && !other.range.nan &&
                !other.has_terms)
                return true;
        }
    if (larger.code == extended(GLSLstd450FMax))
        return is_at_most(a, operands[0], depth + 1) || is_at_most(a, operands[1], depth + 1);
    return false;
}

}  // namespace gobo::prove
