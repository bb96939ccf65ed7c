// Cycles of chips beside the errors of a study.
#pragma once

#include "lab/cost/cost_table.hpp"

namespace gobo::cost {

inline constexpr std::array<std::string_view, 5> kStudyColumns = {"effects", "key", "scene", "error_max",
                                                                  "vertices_per_fragment"};

/// A study.csv with four columns more for each chip: cycles_NAME, of 64 fragments with their part of the
/// vertices (vertices_per_fragment), empty where a stage has a loop or no figures; front_NAME, yes where no
/// row of the same effects and scene that errs as little takes fewer; driver_NAME, with the architecture;
/// instructions_NAME, of the fragment stage by kind. What it had of these chips is written anew. It must have
/// kStudyColumns.
[[nodiscard]] CsvTable with_cycles(CsvTable study, const std::vector<ChipCost>& costs);

/// The rows of a study with cycles that a summary of it holds, and those of the same scenes that are on the
/// front of a chip. Both must have kStudyColumns.
[[nodiscard]] CsvTable summary_of(const CsvTable& study, const CsvTable& summary);

}  // namespace gobo::cost
