// Budgets on the command line: which quality each combination of effects is built with.
#pragma once

#include <string>
#include <vector>

#include "emit/emit.hpp"
#include "gobo/command.hpp"

namespace gobo {

struct BudgetOptions {
    double max_error = 0;  ///< 0: no limit
    double max_cost = 0;   ///< 0: no limit
    std::string study;     ///< a study.csv or summary.csv; empty: the shipped one of the family

    [[nodiscard]] bool is_set() const { return max_error > 0 || max_cost > 0; }
};

void add_budget_options(CLI::App& app, BudgetOptions& options);

/// For each key the one that the budget chooses for its effects, in the same order, with what it was chosen
/// by. Effects that the study has not measured are measured now, on the study's scenes, at the qualities that
/// lie on a front of the study. Keys that the dialect forbids are not chosen. Errors: no quality within the
/// budget, for each combination; a study that cannot be read (its file is added to `family.files`).
[[nodiscard]] Result<std::vector<QualityChoice>> choose_qualities(const World& world, LoadedFamily& family,
                                                                  const BudgetOptions& options,
                                                                  const std::vector<Key>& keys,
                                                                  std::string_view dialect, int jobs);

}  // namespace gobo
