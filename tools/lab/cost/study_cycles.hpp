// Cycles of chips beside the errors of a study.
#pragma once

#include "lab/cost/cost_table.hpp"

namespace gobo::cost {

inline constexpr std::array<std::string_view, 5> kStudyColumns = {"effects", "key", "scene", "error_max",
                                                                  "vertices_per_fragment"};

/// A study.csv with three columns more for each chip: cycles_NAME, of 64 fragments with their part of the
/// vertices (vertices_per_fragment), empty where a stage has a loop or no figures; front_NAME, yes where no
/// row of the same effects and scene that errs as little takes fewer; driver_NAME. What it had of these chips
/// is written anew. It must have kStudyColumns.
[[nodiscard]] CsvTable with_cycles(CsvTable study, const std::vector<ChipCost>& costs);

}  // namespace gobo::cost
