// Error against cost, with the front.
#pragma once

#include <string>
#include <vector>

#include "lab/study/chart.hpp"
#include "lab/study/study_csv.hpp"

namespace gobo::study {

/// Error against cost. `rate` are the features that say where light is computed: the first one colours the
/// points. What is on the front is numbered in the order of front_of().
[[nodiscard]] Chart front_chart(const Family& family, const std::vector<std::string>& rate,
                                const std::vector<const StudyRow*>& rows, std::string title);

}  // namespace gobo::study
