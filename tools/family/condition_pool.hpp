// Conditions stored once each, so that what is left of a condition after deciding a feature is compared by
// number.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "family/expression.hpp"
#include "family/family.hpp"

namespace gobo {

/// Mixes all of the numbers into the seed.
[[nodiscard]] std::size_t hash_of(const auto& numbers, std::size_t seed) {
    for (const auto number : numbers)
        seed = (seed ^ (seed >> 29U)) * 0xBF58476D1CE4E5B9U + static_cast<std::size_t>(number);
    return seed ^ (seed >> 32U);
}

/// Hash-consed conditions. Equal conditions have equal numbers; `never` and `always` are the two constants.
class ConditionPool {
  public:
    using Id = int;
    static constexpr Id never = 0;
    static constexpr Id always = 1;

    explicit ConditionPool(const std::vector<Feature>& features);

    Id add(const Expression& expression);
    Id disjoin(std::vector<Id> parts) { return junction(Expression::Kind::disjunction, std::move(parts)); }
    /// The features' values added, compared with a number. ~feature: its value is subtracted.
    Id compare(std::vector<int> terms, Expression::Comparison comparison, int value);

    /// What is left of a condition once `feature` has the value. Later features are still open.
    Id assign(Id condition, int feature, int value);

    /// The features that a condition looks at, and those of each of its parts that looks at several.
    void collect(Id condition, std::vector<std::vector<int>>& groups) const;

    [[nodiscard]] std::size_t size() const { return nodes_.size(); }

  private:
    struct Node {
        Expression::Kind kind = Expression::Kind::conjunction;
        Expression::Comparison comparison = Expression::Comparison::equal;
        int value = 0;
        std::vector<int> operands = {};  ///< compare: terms; otherwise: conditions
        bool operator==(const Node&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Node& node) const {
            const auto form =
                static_cast<std::size_t>(node.kind) * 8 + static_cast<std::size_t>(node.comparison);
            return hash_of(node.operands, (form << 32U) + static_cast<std::uint32_t>(node.value));
        }
    };

    Id intern(Node node);
    Id junction(Expression::Kind kind, std::vector<Id> parts);

    std::vector<int> largest_values_;  ///< per feature
    std::unordered_map<Node, Id, Hash> ids_;
    std::vector<const Node*> nodes_;        ///< by Id: the keys of `ids_`, which never move
    std::vector<std::uint64_t> mentioned_;  ///< by Id: a bit for each feature, every 64th sharing one
    int assigned_feature_ = -1;
    std::unordered_map<std::uint64_t, Id> assigned_;  ///< by condition and value of `assigned_feature_`
};

}  // namespace gobo
