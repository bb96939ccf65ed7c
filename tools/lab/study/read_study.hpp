// A study's CSV read back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lab/study/study_csv.hpp"

namespace gobo::study {

/// The rows of one combination of effects over all scenes, from a study.csv or summary.csv: keys, errors,
/// costs, the front, and the times of fragments. Errors, at `path` and the line: a missing column, a key that
/// the family does not have, effects that the study does not hold.
[[nodiscard]] Result<std::vector<StudyRow>> read_rows(std::string_view csv, const std::string& path,
                                                      const Family& family, const Key& effects);

}  // namespace gobo::study
