#include "family/condition_pool.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace gobo {
namespace {

using Kind = Expression::Kind;
using Comparison = Expression::Comparison;

/// The truth of `sum comparison value` where it is the same for every sum in [0, largest]; nothing otherwise.
std::optional<bool> decided(int largest, Comparison comparison, int value) {
    const bool at_zero = compare(0, comparison, value);
    const bool at_largest = compare(largest, comparison, value);
    if (at_zero != at_largest) return std::nullopt;
    const bool is_point = comparison == Comparison::equal || comparison == Comparison::not_equal;
    if (is_point && value > 0 && value < largest) return std::nullopt;
    return at_zero;
}

std::uint64_t bit_of(int feature) {
    return std::uint64_t{1} << (static_cast<unsigned>(feature) % 64U);
}

}  // namespace

ConditionPool::ConditionPool(const std::vector<Feature>& features) {
    for (const Feature& feature : features)
        largest_values_.push_back(static_cast<int>(feature.values.size()) - 1);
    nodes_.push_back({Kind::constant, {}, Comparison::equal, 0});
    nodes_.push_back({Kind::constant, {}, Comparison::equal, 1});
    mentioned_ = {0, 0};
}

ConditionPool::Id ConditionPool::add(const Expression& expression) {
    std::vector<Id> parts;
    for (const auto& part : expression.parts) parts.push_back(add(*part));
    switch (expression.kind) {
        case Kind::constant:
            return expression.constant ? always : never;
        case Kind::compare:
            return compare(expression.features, expression.comparison, expression.value);
        case Kind::conjunction:
            return conjoin(std::move(parts));
        case Kind::disjunction:
            return disjoin(std::move(parts));
        case Kind::negation:
            return negate(parts.front());
    }
    return never;
}

ConditionPool::Id ConditionPool::intern(Node node) {
    const auto [at, is_new] = ids_.try_emplace(node, static_cast<Id>(nodes_.size()));
    if (!is_new) return at->second;
    std::uint64_t mentioned = 0;
    for (const int operand : node.operands)
        mentioned |=
            node.kind == Kind::compare ? bit_of(operand) : mentioned_[static_cast<std::size_t>(operand)];
    mentioned_.push_back(mentioned);
    nodes_.push_back(std::move(node));
    return at->second;
}

bool ConditionPool::mentions(Id condition, int feature) const {
    return (mentioned_[static_cast<std::size_t>(condition)] & bit_of(feature)) != 0;
}

ConditionPool::Id ConditionPool::compare(std::vector<int> features, Comparison comparison, int value) {
    int largest = 0;
    for (const int feature : features) largest += largest_values_[static_cast<std::size_t>(feature)];
    if (const auto truth = decided(largest, comparison, value)) return *truth ? always : never;
    std::sort(features.begin(), features.end());
    return intern({Kind::compare, std::move(features), comparison, value});
}

ConditionPool::Id ConditionPool::negate(Id condition) {
    if (condition == never) return always;
    if (condition == always) return never;
    const Node& node = nodes_[static_cast<std::size_t>(condition)];
    if (node.kind == Kind::negation) return node.operands.front();
    return intern({Kind::negation, {condition}, Comparison::equal, 0});
}

ConditionPool::Id ConditionPool::conjoin(std::vector<Id> parts) {
    return junction(Kind::conjunction, std::move(parts));
}

ConditionPool::Id ConditionPool::disjoin(std::vector<Id> parts) {
    return junction(Kind::disjunction, std::move(parts));
}

ConditionPool::Id ConditionPool::junction(Kind kind, std::vector<Id> parts) {
    const Id absorbing = kind == Kind::conjunction ? never : always;
    const Id neutral = kind == Kind::conjunction ? always : never;
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    if (std::find(parts.begin(), parts.end(), absorbing) != parts.end()) return absorbing;
    std::erase(parts, neutral);
    if (parts.empty()) return neutral;
    if (parts.size() == 1) return parts.front();
    return intern({kind, std::move(parts), Comparison::equal, 0});
}

ConditionPool::Id ConditionPool::assign(Id condition, int feature, int value) {
    if (!mentions(condition, feature)) return condition;
    // A key has far fewer features, and a feature fewer values, than 65,536: a selection could not name them.
    const std::uint64_t question = static_cast<std::uint64_t>(condition) << 32U |
                                   static_cast<std::uint64_t>(feature) << 16U |
                                   static_cast<std::uint64_t>(value);
    if (const auto known = assigned_.find(question); known != assigned_.end()) return known->second;
    const Node node = nodes_[static_cast<std::size_t>(condition)];  // a copy: new conditions move the nodes
    const Id left = assign_parts(node, feature, value);
    assigned_.emplace(question, left);
    return left;
}

ConditionPool::Id ConditionPool::assign_parts(const Node& node, int feature, int value) {
    if (node.kind == Kind::compare) {
        if (std::find(node.operands.begin(), node.operands.end(), feature) == node.operands.end())
            return intern(node);
        std::vector<int> open;
        std::remove_copy(node.operands.begin(), node.operands.end(), std::back_inserter(open), feature);
        const auto times = static_cast<int>(node.operands.size() - open.size());
        return compare(std::move(open), node.comparison, node.value - times * value);
    }
    std::vector<Id> parts;
    for (const Id part : node.operands) parts.push_back(assign(part, feature, value));
    if (node.kind == Kind::negation) return negate(parts.front());
    return junction(node.kind, std::move(parts));
}

}  // namespace gobo
