// The front of a finished study, for readers: a short table, and a chart of error against cost.
#pragma once

#include <string>
#include <vector>

#include "lab/study/chart.hpp"
#include "lab/study/rows.hpp"

namespace gobo::study {

/// What is on the front, most accurate first.
[[nodiscard]] std::vector<const StudyRow*> front_of(const std::vector<const StudyRow*>& rows);

/// A table in Markdown, of at most six lines: the most accurate quality on the front, then for each power of
/// ten of the error the cheapest within it, then what lies furthest between.
[[nodiscard]] std::string front_table(const std::vector<StudyRow>& rows);

/// Error against cost. `rate` are the features that say where light is computed: the first one colours the
/// points. What is on the front is numbered in the order of front_of().
[[nodiscard]] Chart front_chart(const Family& family, const std::vector<std::string>& rate,
                                const std::vector<const StudyRow*>& rows, std::string title);

/// "12.3 (11.9 to 12.8)".
[[nodiscard]] std::string spread_text(const Spread& spread);

}  // namespace gobo::study
