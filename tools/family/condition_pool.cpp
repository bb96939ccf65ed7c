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

std::size_t ConditionPool::Hash::operator()(const Node& node) const {
    std::size_t hash = (static_cast<std::size_t>(node.kind) * 8 + static_cast<std::size_t>(node.comparison)) *
                           0x9E3779B97F4A7C15U +
                       static_cast<std::size_t>(node.value);
    for (const int operand : node.operands)
        hash = (hash ^ (hash >> 29U)) * 0xBF58476D1CE4E5B9U + static_cast<std::size_t>(operand);
    return hash ^ (hash >> 32U);
}

ConditionPool::ConditionPool(const std::vector<Feature>& features) {
    for (const Feature& feature : features)
        largest_values_.push_back(static_cast<int>(feature.values.size()) - 1);
    intern({Kind::constant, Comparison::equal, 0, {}});
    intern({Kind::constant, Comparison::equal, 1, {}});
}

ConditionPool::Id ConditionPool::add(const Expression& expression) {
    std::vector<Id> parts;
    for (const auto& part : expression.parts) parts.push_back(add(*part));
    switch (expression.kind) {
        case Kind::constant:
            return expression.constant ? always : never;
        case Kind::compare: {
            std::vector<int> terms = expression.features;
            for (const int feature : expression.subtracted) terms.push_back(~feature);
            return compare(std::move(terms), expression.comparison, expression.value);
        }
        case Kind::conjunction:
        case Kind::disjunction:
            return junction(expression.kind, std::move(parts));
        case Kind::negation:
            return negate(parts.front());
    }
    return never;
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
    std::sort(terms.begin(), terms.end());
    return intern({Kind::compare, comparison, value, std::move(terms)});
}

ConditionPool::Id ConditionPool::negate(Id condition) {
    if (condition == never) return always;
    if (condition == always) return never;
    const Node& node = *nodes_[condition];
    if (node.kind == Kind::negation) return static_cast<Id>(node.operands.front());
    return intern({Kind::negation, Comparison::equal, 0, {static_cast<int>(condition)}});
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
    return intern({kind, Comparison::equal, 0, {parts.begin(), parts.end()}});
}

ConditionPool::Id ConditionPool::assign(Id condition, int feature, int value) {
    if ((mentioned_[condition] & bit_of(feature)) == 0) return condition;
    const Node& node = *nodes_[condition];
    if (node.kind == Kind::compare) return assign_terms(node, feature, value);
    if (std::exchange(assigned_feature_, feature) != feature) assigned_.clear();
    const std::uint64_t question = std::uint64_t{condition} << 32U | static_cast<std::uint32_t>(value);
    if (const auto known = assigned_.find(question); known != assigned_.end()) return known->second;
    std::vector<Id> parts;
    for (const int part : node.operands) parts.push_back(assign(static_cast<Id>(part), feature, value));
    const Id left =
        node.kind == Kind::negation ? negate(parts.front()) : junction(node.kind, std::move(parts));
    assigned_.emplace(question, left);
    return left;
}

ConditionPool::Id ConditionPool::assign_terms(const Node& node, int feature, int value) {
    int sum = 0;
    std::vector<int> open;
    for (const int term : node.operands) {
        if (feature_of(term) != feature)
            open.push_back(term);
        else
            sum += term < 0 ? -value : value;
    }
    return compare(std::move(open), node.comparison, node.value - sum);
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
            collect(static_cast<Id>(operand), groups);
            const std::vector<int> features = groups[part];
            groups[own].insert(groups[own].end(), features.begin(), features.end());
        }
    }
    std::sort(groups[own].begin(), groups[own].end());
    groups[own].erase(std::unique(groups[own].begin(), groups[own].end()), groups[own].end());
}

}  // namespace gobo
