// Which choices are worth their price: the Pareto front of error against cost.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace gobo::study {

struct Priced {
    double cost = 0;
    double error = 0;
};

/// Whether `a` is neither dearer nor less accurate than `b`, and better in one of them.
[[nodiscard]] bool dominates(const Priced& a, const Priced& b);

/// For each point the index of one that dominates it and is itself on the front (the cheapest such); nothing
/// for those on the front.
[[nodiscard]] std::vector<std::optional<std::size_t>> dominators(const std::vector<Priced>& points);

/// The points that no other one beats by more than these factors: dearer than `cost_slack` times its cost and
/// less accurate than `error_slack` times its error, at once.
[[nodiscard]] std::vector<bool> near_front(const std::vector<Priced>& points, double cost_slack,
                                           double error_slack);

}  // namespace gobo::study
