// The front of a finished study, for readers: a short table.
#pragma once

#include <string>
#include <vector>

#include "lab/study/study_csv.hpp"

namespace gobo::study {

/// At most so many lines are enough to see what a budget buys.
inline constexpr std::size_t kFrontLines = 6;

/// A table in Markdown: the most accurate quality on the front, then for each power of ten of the error the
/// cheapest within it, then what lies furthest between, up to kFrontLines.
[[nodiscard]] std::string front_table(const std::vector<StudyRow>& rows);

/// "12.3 (11.9 to 12.8)".
[[nodiscard]] std::string spread_text(const Spread& spread);

/// What is on the front, most accurate first.
[[nodiscard]] std::vector<const StudyRow*> front_of(const std::vector<const StudyRow*>& rows);

}  // namespace gobo::study
