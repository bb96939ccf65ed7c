#include "lab/study/front.hpp"

#include <algorithm>

namespace gobo::study {

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
