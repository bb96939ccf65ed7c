// What gobo cost asks drivers' compilers about: permutations as pipelines, each distinct one once.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lab/commands/lab_input.hpp"
#include "lab/cost/compile_on_chips.hpp"
#include "lab/cost/cost_table.hpp"

namespace gobo {

/// The options of gobo cost.
struct CostCommandOptions : SelectionOptions {
    std::vector<std::string> names;  ///< FAMILY, or files
    std::vector<std::string> stages;
    std::vector<std::string> gpus;
    std::string driver;  ///< find_driver()'s `where`
    bool json = false;
    bool csv = false;
    bool isa = false;
    bool cycles = false;
    bool specialized = false;
    std::string against;   ///< a key
    std::string baseline;  ///< a CSV file
    double tolerance = 2;  ///< percent
    bool update = false;
    std::string study;   ///< a study.csv
    std::string folder;  ///< for SPIR-V that a driver does not take; empty: it is not kept
};

/// A permutation's stages and the values of its specialisation constants by constant_id.
struct PipelineKey {
    StageNumbers stages;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> constants = {};

    friend auto operator<=>(const PipelineKey&, const PipelineKey&) = default;
};

/// What is compiled: each distinct pipeline once.
struct Pipelines {
    std::vector<cost::Pipeline> list;
    std::map<PipelineKey, std::size_t> numbers;  ///< index into the list
    Diagnostics errors;                          ///< of permutations that are no pipeline
};

/// Whether drivers are asked about such stages: a vertex and a fragment stage, or a compute stage.
[[nodiscard]] bool is_costed(const StageNumbers& stages);

[[nodiscard]] cost::CompileOptions compile_options(const CostCommandOptions& options, const World& world);

/// A permutation's stages with the values of its constants. Errors: what Vulkan does not take.
[[nodiscard]] Result<cost::Pipeline> pipeline_of(const Composition& composition, const Validated& validated,
                                                 const Permutation& permutation);

/// "fog=linear", or the files' names, with the key where they have several.
[[nodiscard]] std::string text_of(const CostCommandOptions& options, const Subject& subject,
                                  const Permutation& permutation);

[[nodiscard]] Pipelines pipelines_of(const CostCommandOptions& options, const Subject& subject,
                                     const Validated& validated);

/// A pipeline that a driver did not compile, its SPIR-V where -o says.
[[nodiscard]] Diagnostics report_failure(const World& world, const CostCommandOptions& options,
                                         const cost::Chip& chip, const cost::Pipeline& pipeline,
                                         const std::string& key, const std::string& reason);

/// The costs of every permutation that a chip's driver compiles; what fails is added to `diagnostics`.
[[nodiscard]] std::vector<cost::ChipCost> costs_of(const World& world, const CostCommandOptions& options,
                                                   const Subject& subject, const Pipelines& pipelines,
                                                   const std::vector<cost::Chip>& chips,
                                                   Diagnostics& diagnostics);

/// gobo cost --specialized: every key twice, with its counts as literals, and with those that the family
/// wants specialised as constants of the pipeline. What assembly the drivers make of both, and what is saved
/// of SPIR-V.
[[nodiscard]] Result<Outcome> compare_specialized(const World& world, const CostCommandOptions& options,
                                                  const std::vector<cost::Chip>& chips);

}  // namespace gobo
