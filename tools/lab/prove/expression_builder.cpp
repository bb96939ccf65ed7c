#include "lab/prove/expression_builder.hpp"

#include <bit>

namespace gobo::prove {

std::size_t ExpressionBuilder::HashOfKey::operator()(const Key& key) const {
    std::size_t hash = key.code * 31U + key.part * 7U + key.field * 131U + (key.is_precise ? 1 : 0);
    for (const Id operand : key.operands) hash = hash * 1000003U ^ operand;
    return hash;
}

ExpressionBuilder::Id ExpressionBuilder::add(Expression expression, const std::vector<Id>& operands,
                                             const Range& known) {
    expression.first = static_cast<std::uint32_t>(expressions_.operands.size());
    expression.count = static_cast<std::uint32_t>(operands.size());
    expression.context = context_;
    expressions_.operands.insert(expressions_.operands.end(), operands.begin(), operands.end());
    const auto id = static_cast<Id>(expressions_.all.size());
    expressions_.all.push_back(expression);
    expressions_.known.push_back(known);
    expressions_.events.push_back({Event::Kind::expression, id});
    ranges_.compute(id);
    return id;
}

ExpressionBuilder::Id ExpressionBuilder::constant(double value, Scalar scalar) {
    // By bits, since no order holds a NaN; both zeros are one.
    const auto bits = std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value);
    const auto [found, is_new] = constants_.try_emplace({bits, scalar}, 0);
    if (is_new) {
        // Constants belong to no context.
        const std::uint32_t context = context_;
        enter(0);
        found->second = add({.code = kConstant, .scalar = scalar}, {}, exactly(value));
        enter(context);
    }
    return found->second;
}

ExpressionBuilder::Id ExpressionBuilder::make(const Expression& expression, std::vector<Id> operands) {
    Key key{expression.code, expression.part, expression.field, expression.is_precise, std::move(operands)};
    std::vector<Id>& same = known_expressions_[key];
    for (const Id id : same)
        if (expression.code == kKept
                ? context_ == expressions_.all[id].context
                : is_within(expressions_.contexts, context_, expressions_.all[id].context))
            return id;
    const Id id = add(expression, key.operands);
    const Known& known = ranges_[id];
    Id result = id;
    if (expression.code != kKept && known.range.is_one() && !known.has_product && !known.has_terms &&
        !known.makes_infinity && ranges_.is_reached())
        result = constant(known.range.low, expression.scalar);
    known_expressions_[key].push_back(result);
    return result;
}

void ExpressionBuilder::enter(std::uint32_t context) {
    if (context == context_) return;
    context_ = context;
    std::vector<Event>& events = expressions_.events;
    // A context in which nothing was computed leaves no trace.
    if (!events.empty() && events.back().kind == Event::Kind::context) events.pop_back();
    events.push_back({Event::Kind::context, context});
    ranges_.enter(context);
}

std::uint32_t ExpressionBuilder::inside(std::uint32_t parent, Id condition, bool is_true) {
    const auto [found, is_new] = inner_contexts_.try_emplace({parent, condition, is_true}, 0);
    if (is_new) {
        found->second = static_cast<std::uint32_t>(expressions_.contexts.size());
        expressions_.contexts.push_back(
            {parent, condition, is_true, expressions_.contexts[parent].depth + 1});
    }
    return found->second;
}

std::uint32_t ExpressionBuilder::list(std::vector<std::uint32_t> numbers) {
    const auto [found, is_new] =
        lists_.try_emplace(numbers, static_cast<std::uint32_t>(expressions_.lists.size()));
    if (is_new) expressions_.lists.push_back(std::move(numbers));
    return found->second;
}

ExpressionBuilder::Id ExpressionBuilder::plain(Id id) {
    const Known& known = ranges_[id];
    if (!known.has_product && !known.has_terms) return id;
    return make({.code = kPlain, .scalar = scalar_of(id)}, {id});
}

ExpressionBuilder::Id ExpressionBuilder::indexed(Id offset, const std::vector<Id>& all,
                                                 const std::vector<std::uint32_t>& offsets) {
    const Range& range = ranges_.range(offset);
    if (range.is_one())
        for (std::size_t i = 0; i < offsets.size(); ++i)
            if (offsets[i] == range.low) return plain(all[i]);
    std::vector<Id> operands{offset};
    operands.insert(operands.end(), all.begin(), all.end());
    return make({.code = kIndexed, .field = list(offsets), .scalar = scalar_of(all.back())}, operands);
}

ExpressionBuilder::Id ExpressionBuilder::replaced(Id offset, std::uint32_t at, Id given, Id old) {
    const Range& range = ranges_.range(offset);
    if (range.is_one()) return range.low == at ? plain(given) : old;
    if (range.low > at || range.high < at) return old;
    return make({.code = kReplaced, .part = at, .scalar = scalar_of(given)}, {offset, given, old});
}

ExpressionBuilder::Id ExpressionBuilder::selected(Id condition, Id yes, Id no) {
    const Range& range = ranges_.range(condition);
    if (range.is_one()) return range.low != 0 ? yes : no;
    if (yes == no) return yes;
    const std::uint32_t outer = context_;
    const std::uint32_t contexts[] = {inside(outer, condition, true), inside(outer, condition, false)};
    std::vector<Id> operands;
    for (std::size_t i = 0; i < 2; ++i) {
        enter(contexts[i]);
        const Id id = i == 0 ? yes : no;
        operands.push_back(make({.code = kKept, .scalar = scalar_of(id)}, {id}));
    }
    enter(outer);
    return make({.code = kJoined, .field = list({contexts[0], contexts[1]}), .scalar = scalar_of(yes)},
                operands);
}

}  // namespace gobo::prove
