// The front of a finished study, for readers: a short table and its chart.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/chart.hpp"
#include "study/study_csv.hpp"

namespace gobo::study {

/// The rows of one combination of effects over all scenes, from a study.csv or summary.csv: keys, errors,
/// costs, the front, and the times of fragments. Errors, at `path` and the line: a missing column, a key that
/// the family does not have, effects that the study does not hold.
[[nodiscard]] Result<std::vector<StudyRow>> read_rows(std::string_view csv, const std::string& path,
                                                      const Family& family, const Key& effects);

/// At most so many lines are enough to see what a budget buys.
inline constexpr std::size_t kFrontLines = 6;

/// A table in Markdown: the most accurate quality on the front, then for each power of ten of the error the
/// cheapest within it.
[[nodiscard]] std::string front_table(const std::vector<StudyRow>& rows);

/// Error against cost. `rate` are the features that say where light is computed: the first one colours the
/// points. What is on the front is numbered in the order of front_of().
[[nodiscard]] Chart front_chart(const Family& family, const std::vector<std::string>& rate,
                                const std::vector<const StudyRow*>& rows, std::string title);

/// "12.3 (11.9 to 12.8)".
[[nodiscard]] std::string spread_text(const Spread& spread);

/// What is on the front, most accurate first.
[[nodiscard]] std::vector<const StudyRow*> front_of(const std::vector<const StudyRow*>& rows);

}  // namespace gobo::study
