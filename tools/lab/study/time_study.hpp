// Adds times to a study's errors and costs.
#pragma once

#include "lab/study/study.hpp"

namespace gobo::study {

struct TimeOptions {
    int rounds = kLeastRounds;
    int jobs = 1;
    std::string machine;  ///< times of another machine are no times of this one
    Progress progress = [](std::string_view, std::size_t, std::size_t) {};
};

/// Times, of each combination of effects, the most accurate key, every single choice and what lies on the
/// front over all scenes, at most kMostTimed. Each combination is one interleaved group with its own control.
/// Groups that the journal holds for this renderer are not drawn again.
[[nodiscard]] Result<void> time_study(const FileSystem& shipped, const Family& family,
                                      const SearchPath& search, const Context& context,
                                      const Weights& weights, const TimeOptions& options, Journal& journal,
                                      Study& study);

inline constexpr std::size_t kMostTimed = 40;

/// How the weighted cost of a fragment goes with its time over all timed keys. Both lists in the same order.
struct CostAndTime {
    std::vector<double> cost;
    std::vector<double> nanoseconds;
    double correlation = 0;  ///< of ranks
};

/// By the processor's time where the renderer draws in the calling thread, else by the elapsed time. For
/// fragments, or for vertices.
[[nodiscard]] CostAndTime cost_against_time(const Study& study, const Weights& weights, bool of_vertices);

/// The slopes to rank by: see cost_against_time().
[[nodiscard]] const Slopes& ranked_slopes(const Timing& timing);

}  // namespace gobo::study
