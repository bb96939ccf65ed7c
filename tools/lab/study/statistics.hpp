// Small statistics of repeated measurements.
#pragma once

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

}  // namespace gobo::study
