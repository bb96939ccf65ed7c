// Costs of permutations on chips, as tables, JSON and differences.
#pragma once

#include <nlohmann/json.hpp>

#include "core/csv.hpp"
#include "lab/cost/chips.hpp"
#include "lab/cost/stage_cost.hpp"

namespace gobo::cost {

struct KeyCost {
    std::string key;  ///< as text; of loose files their names
    std::vector<StageCost> stages;
};

struct ChipCost {
    Chip chip;
    std::string driver;         ///< "radv Mesa 22.3.6"
    std::vector<KeyCost> keys;  ///< those that the driver compiled
};

/// A figure of a stage, as tables have it.
struct Figure {
    std::string_view name;   ///< in CSV and JSON
    std::string_view title;  ///< for readers
    std::uint64_t StageCost::*value;
};
[[nodiscard]] const std::vector<Figure>& figures();

/// A table for each chip.
[[nodiscard]] std::string to_text(const std::vector<ChipCost>& costs);
/// A column of cycles for each chip, a row for each key and stage.
[[nodiscard]] std::string cycles_text(const std::vector<ChipCost>& costs);
/// A row for each chip, key and stage, with the driver's version.
[[nodiscard]] CsvTable to_table(const std::vector<ChipCost>& costs);
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<ChipCost>& costs, bool with_assembly);
[[nodiscard]] std::string assembly_text(const std::vector<ChipCost>& costs);

/// How a figure changed, "+5.0 %"; empty where it was 0.
[[nodiscard]] std::string percent_text(std::uint64_t before, std::uint64_t after);
/// "arithmetic +12, move -3": the kinds of which there are more or fewer.
[[nodiscard]] std::string kinds_text(const ByKind& before, const ByKind& after);
/// For each chip and stage how one key's figures change to another's; empty for a chip that lacks one of
/// them.
[[nodiscard]] std::string difference_text(const std::vector<ChipCost>& costs, const std::string& before,
                                          const std::string& after);

}  // namespace gobo::cost
