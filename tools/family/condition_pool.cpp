#include "family/condition_pool.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace gobo {
namespace {

using Kind = Expression::Kind;
using Comparison = Expression::Comparison;

/// The truth of `sum comparison value` where it is the same for every sum in [low, high]; nothing otherwise.
std::optional<bool> decided(int low, int high, Comparison comparison, int value) {
    const bool at_low = compare(low, comparison, value);
    const bool is_point = comparison == Comparison::equal || comparison == Comparison::not_equal;
    const bool inside = is_point && value > low && value < high;
    if (at_low != compare(high, comparison, value) || inside) return std::nullopt;
    return at_low;
}

int feature_of(int term) {
    return term < 0 ? ~term : term;
}

std::uint64_t bit_of(int feature) {
    return std::uint64_t{1} << (static_cast<unsigned>(feature) % 64U);
}

}  // namespace

ConditionPool::ConditionPool(const std::vector<Feature>& features) {
    for (const Feature& feature : features)
        largest_values_.push_back(static_cast<int>(feature.values.size()) - 1);
    intern({.kind = Kind::disjunction});  // of nothing: never
    intern({.kind = Kind::conjunction});  // of nothing: always
}

ConditionPool::Id ConditionPool::add(const Expression& expression) {
    if (expression.kind == Kind::compare) {
        std::vector<int> terms = expression.features;
        for (const int feature : expression.subtracted) terms.push_back(~feature);
        return compare(std::move(terms), expression.comparison, expression.value);
    }
    std::vector<Id> parts;
    for (const Expression& part : expression.parts) parts.push_back(add(part));
    return junction(expression.kind, std::move(parts));
}

ConditionPool::Id ConditionPool::intern(Node node) {
    const auto [at, is_new] = ids_.try_emplace(std::move(node), static_cast<Id>(nodes_.size()));
    if (!is_new) return at->second;
    std::uint64_t mentioned = 0;
    for (const int operand : at->first.operands)
        mentioned |= at->first.kind == Kind::compare ? bit_of(feature_of(operand)) : mentioned_[operand];
    mentioned_.push_back(mentioned);
    nodes_.push_back(&at->first);
    return at->second;
}

ConditionPool::Id ConditionPool::compare(std::vector<int> terms, Comparison comparison, int value) {
    int low = 0, high = 0;
    for (const int term : terms)
        (term < 0 ? low : high) += (term < 0 ? -1 : 1) * largest_values_[feature_of(term)];
    if (const auto truth = decided(low, high, comparison, value)) return *truth ? always : never;
    std::ranges::sort(terms);
    return intern({Kind::compare, comparison, value, std::move(terms)});
}

ConditionPool::Id ConditionPool::junction(Kind kind, std::vector<Id> parts) {
    const Id absorbing = kind == Kind::conjunction ? never : always;
    const Id neutral = kind == Kind::conjunction ? always : never;
    std::ranges::sort(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    if (std::ranges::count(parts, absorbing) > 0) return absorbing;
    std::erase(parts, neutral);
    if (parts.empty()) return neutral;
    if (parts.size() == 1) return parts.front();
    return intern({.kind = kind, .operands = std::move(parts)});
}

ConditionPool::Id ConditionPool::assign(Id condition, int feature, int value) {
    if ((mentioned_[condition] & bit_of(feature)) == 0) return condition;
    const Node& node = *nodes_[condition];
    if (node.kind == Kind::compare) {
        std::vector<int> open = node.operands;
        const auto count = static_cast<int>(std::erase(open, feature));
        const auto subtracted_count = static_cast<int>(std::erase(open, ~feature));
        return compare(std::move(open), node.comparison, node.value - (count - subtracted_count) * value);
    }
    if (std::exchange(assigned_feature_, feature) != feature) assigned_.clear();
    const std::uint64_t question =
        static_cast<std::uint64_t>(condition) << 32U | static_cast<std::uint32_t>(value);
    if (const auto known = assigned_.find(question); known != assigned_.end()) return known->second;
    std::vector<Id> parts;
    for (const Id part : node.operands) parts.push_back(assign(part, feature, value));
    return assigned_[question] = junction(node.kind, std::move(parts));
}

void ConditionPool::collect(Id condition, std::vector<std::vector<int>>& groups) const {
    const Node& node = *nodes_[condition];
    const std::size_t own = groups.size();
    groups.emplace_back();
    for (const int operand : node.operands) {
        if (node.kind == Kind::compare) {
            groups[own].push_back(feature_of(operand));
        } else {
            const std::size_t part = groups.size();
            collect(operand, groups);
            const std::vector<int> features = groups[part];
            groups[own].insert(groups[own].end(), features.begin(), features.end());
        }
    }
    std::ranges::sort(groups[own]);
    groups[own].erase(std::unique(groups[own].begin(), groups[own].end()), groups[own].end());
}

}  // namespace gobo
