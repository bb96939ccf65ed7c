// What each value of each quality feature costs and buys, taken one at a time; which are dominated
// everywhere.
#pragma once

#include <string>
#include <vector>

#include "lab/study/study.hpp"

namespace gobo::study {

struct ChoiceSummary {
    std::string feature;
    std::string value;
    bool is_most_accurate = false;
    bool is_excluded = false;      ///< by the family
    std::size_t combinations = 0;  ///< of effects that it matters to
    double error_max = 0;          ///< alone, the worst over scenes and effects
    double error_rms = 0;
    double least_cost = 0;  ///< alone, relative to the most accurate key
    double most_cost = 0;
    /// The value that is neither dearer nor less accurate than this one in every pair of keys that differ in
    /// this feature alone, on every scene, and better in some. Empty: there is none.
    std::string dominated_by;
    std::size_t pairs = 0;  ///< of keys that say so
};

[[nodiscard]] std::vector<ChoiceSummary> summarise_choices(const Family& family, const Study& study,
                                                           const Weights& weights);

}  // namespace gobo::study
