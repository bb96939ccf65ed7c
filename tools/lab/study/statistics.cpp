#include "lab/study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gobo::study {
namespace {

double quantile(const std::vector<double>& sorted, double part) {
    const double at = part * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first;
        while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
        for (std::size_t i = first; i <= last; ++i) ranks[order[i]] = static_cast<double>(first + last) / 2;
        first = last + 1;
    }
    return ranks;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75)};
}

double rank_correlation(const std::vector<double>& first, const std::vector<double>& second) {
    if (first.size() < 3 || first.size() != second.size()) return 0;
    const std::vector<double> a = ranks_of(first);
    const std::vector<double> b = ranks_of(second);
    const double mean = static_cast<double>(a.size() - 1) / 2;
    double both = 0;
    double of_a = 0;
    double of_b = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        both += (a[i] - mean) * (b[i] - mean);
        of_a += (a[i] - mean) * (a[i] - mean);
        of_b += (b[i] - mean) * (b[i] - mean);
    }
    return of_a > 0 && of_b > 0 ? both / std::sqrt(of_a * of_b) : 0;
}

bool dominates(const Priced& a, const Priced& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

std::vector<std::optional<std::size_t>> dominators(const std::vector<Priced>& points) {
    std::vector<std::optional<std::size_t>> result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < points.size(); ++j) {
            if (!dominates(points[j], points[i])) continue;
            if (!result[i] || dominates(points[j], points[*result[i]]) ||
                (!dominates(points[*result[i]], points[j]) && points[j].cost < points[*result[i]].cost))
                result[i] = j;
        }
    }
    // A dominator that is itself dominated stands for the one at the end of the chain.
    for (std::optional<std::size_t>& one : result)
        while (one && result[*one]) one = result[*one];
    return result;
}

std::vector<bool> near_front(const std::vector<Priced>& points, double cost_slack, double error_slack) {
    std::vector<bool> near(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        near[i] = std::none_of(points.begin(), points.end(), [&](const Priced& other) {
            return other.cost * cost_slack < points[i].cost && other.error * error_slack < points[i].error;
        });
    }
    return near;
}

}  // namespace gobo::study
