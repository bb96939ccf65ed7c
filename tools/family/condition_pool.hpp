// Conditions stored once each, so that what is left of a condition after deciding a feature is compared by
// number.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "family/expression.hpp"
#include "family/family.hpp"

namespace gobo {

/// Hash-consed conditions. Equal conditions have equal numbers; `never` and `always` are the two constants.
class ConditionPool {
  public:
    using Id = int;
    static constexpr Id never = 0;
    static constexpr Id always = 1;

    explicit ConditionPool(const std::vector<Feature>& features);

    Id add(const Expression& expression);
    Id negate(Id condition);
    Id disjoin(std::vector<Id> parts);
    Id conjoin(std::vector<Id> parts);
    /// The features' values added, compared with a number.
    Id compare(std::vector<int> features, Expression::Comparison comparison, int value);

    /// What is left of a condition once `feature` has the value. Later features are still open.
    Id assign(Id condition, int feature, int value);

  private:
    struct Node {
        Expression::Kind kind = Expression::Kind::constant;
        std::vector<int> operands;  ///< compare: features; otherwise: conditions
        Expression::Comparison comparison = Expression::Comparison::equal;
        int value = 0;
        auto operator<=>(const Node&) const = default;
    };

    /// Whether the condition may depend on the feature; never false where it does.
    [[nodiscard]] bool mentions(Id condition, int feature) const;
    Id assign_parts(const Node& node, int feature, int value);
    Id intern(Node node);
    Id junction(Expression::Kind kind, std::vector<Id> parts);

    std::vector<int> largest_values_;  ///< per feature
    std::vector<Node> nodes_;
    std::vector<std::uint64_t> mentioned_;  ///< per node: a bit for each feature, every 64th sharing one
    std::map<Node, Id> ids_;
    std::unordered_map<std::uint64_t, Id> assigned_;  ///< by condition, feature and value
};

}  // namespace gobo
