// Small statistics: the middle of repeated measurements, ranks, and the Pareto front of error against cost.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace gobo::study {

/// The middle half of repeated measurements, and its middle.
struct Spread {
    double median = 0;
    double low = 0;   ///< first quartile
    double high = 0;  ///< third quartile

    /// No measurable difference: the middle halves share a value.
    [[nodiscard]] bool overlaps(const Spread& other) const { return low <= other.high && other.low <= high; }

    friend bool operator==(const Spread&, const Spread&) = default;
};

/// Quartiles by linear interpolation between the nearest ranks. Zeros for nothing.
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// Spearman's rank correlation; ties share their mean rank. Nothing sensible (0) for fewer than three pairs
/// or where one side is all the same.
[[nodiscard]] double rank_correlation(const std::vector<double>& first, const std::vector<double>& second);

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
