// Costs held against a table of them that was kept.
#pragma once

#include "lab/cost/cost_table.hpp"

namespace gobo::cost {

struct Comparison {
    int stages = 0;  ///< that the baseline has too
    int grown = 0;   ///< by more than the tolerance
    /// An error for each that has grown, and one where the baseline lacks some; a note where it has more.
    Diagnostics diagnostics;
};

/// Compares with the table at `path`, as to_table() makes it: instructions, registers, and cycles where there
/// is no loop, may each grow by so many percent. Errors: a table without the columns or with cells that are
/// no whole number, one of another driver version, or one that holds nothing of what was measured.
[[nodiscard]] Result<Comparison> compare_with_baseline(const std::vector<ChipCost>& costs,
                                                       const CsvTable& baseline, const std::string& path,
                                                       double percent);
/// Whether a table is one: it has the columns that name what each row is of.
[[nodiscard]] bool is_baseline(const CsvTable& table);
/// How many rows of a baseline are of a chip, key and stage that the table in its place lacks.
[[nodiscard]] std::size_t rows_lost(const CsvTable& baseline, const CsvTable& now);

}  // namespace gobo::cost
