// What `gobo study` and the budgets of other commands read, and the few lines that a study ends with.
#pragma once

#include <string>

#include "gobo/command.hpp"
#include "lab/study/study.hpp"

namespace gobo {

/// The first weights of a file; of the shipped data/study/weights.csv where the path is empty.
[[nodiscard]] Result<study::Weights> load_weights(const World& world, const std::string& path);

/// The plan of a file; where the path is empty that which came with the family, data/study/NAME.toml, or
/// default_plan().
[[nodiscard]] Result<study::StudyPlan> load_plan(const World& world, const Family& family,
                                                 const std::string& path);

/// The processor's name; empty where the system does not tell.
[[nodiscard]] std::string machine_name(const FileSystem& disk);

/// For each combination of effects its front's size and ends, the controls of timing, how cost goes with
/// time, and which choices are dominated everywhere.
[[nodiscard]] std::string study_summary(const Family& family, const study::Study& study,
                                        const study::Weights& weights);

}  // namespace gobo
