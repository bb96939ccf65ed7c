#include "lab/cost/cost_table.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::cost {
namespace {

const KeyCost* cost_of_key(const ChipCost& cost, const std::string& key) {
    const auto found = std::find_if(cost.keys.begin(), cost.keys.end(),
                                    [&](const KeyCost& each) { return each.key == key; });
    return found == cost.keys.end() ? nullptr : &*found;
}

std::int64_t signed_difference(std::uint64_t before, std::uint64_t after) {
    return static_cast<std::int64_t>(after) - static_cast<std::int64_t>(before);
}

/// "navi21 (RDNA2), radv Mesa 22.3.6"
std::string heading(const ChipCost& cost) {
    return fmt::format("{} ({}), {}\n", cost.chip.name, cost.chip.architecture, cost.driver);
}

}  // namespace

const std::vector<Figure>& figures() {
    static const std::vector<Figure> kFigures = {
        {"instructions", "instructions", &StageCost::instructions},
        {"vector_registers", "VGPRs", &StageCost::vector_registers},
        {"scalar_registers", "SGPRs", &StageCost::scalar_registers},
        {"occupancy", "occupancy", &StageCost::occupancy},
        {"cycles", "cycles", &StageCost::cycles},
        {"latency", "latency", &StageCost::latency},
        {"code_bytes", "bytes", &StageCost::code_bytes},
        {"spills", "spills", &StageCost::spills},
    };
    return kFigures;
}

std::string to_text(const std::vector<ChipCost>& costs) {
    std::string text;
    for (const ChipCost& cost : costs) {
        if (!text.empty()) text += '\n';
        text += heading(cost);
        for (const Figure& figure : figures()) text += fmt::format("{}  ", figure.title);
        text += "loop  stage     key\n";
        for (const KeyCost& key : cost.keys)
            for (const StageCost& stage : key.stages) {
                for (const Figure& figure : figures())
                    text += fmt::format("{:>{}}  ", stage.*figure.value, figure.title.size());
                text += fmt::format("{:<4}  {:<8}  {}\n", stage.has_loop ? "loop" : "", stage.stage, key.key);
            }
    }
    return text;
}

std::string cycles_text(const std::vector<ChipCost>& costs) {
    std::string text;
    std::string header;
    std::vector<std::size_t> widths;
    for (const ChipCost& cost : costs) {
        text += heading(cost);
        widths.push_back(std::max<std::size_t>(cost.chip.name.size(), 5));
        header += fmt::format("{:>{}}  ", cost.chip.name, widths.back());
    }
    text += header + "stage     key\n";
    // A chip may lack keys that its driver did not compile.
    std::vector<std::pair<std::string, std::string>> rows;
    for (const ChipCost& cost : costs)
        for (const KeyCost& key : cost.keys)
            for (const StageCost& stage : key.stages)
                if (std::pair row(key.key, stage.stage);
                    std::find(rows.begin(), rows.end(), row) == rows.end())
                    rows.push_back(std::move(row));
    bool has_loop = false;
    for (const auto& [key, stage] : rows) {
        for (std::size_t i = 0; i < costs.size(); ++i) {
            std::string cell;
            if (const KeyCost* cost = cost_of_key(costs[i], key))
                for (const StageCost& one : cost->stages)
                    if (one.stage == stage) cell = fmt::format("{}{}", one.has_loop ? "*" : "", one.cycles);
            has_loop = has_loop || cell.starts_with('*');
            text += fmt::format("{:>{}}  ", cell, widths[i]);
        }
        text += fmt::format("{:<8}  {}\n", stage, key);
    }
    if (has_loop) text += "* with a loop, of which the compiler guesses how often it runs\n";
    return text;
}

CsvTable to_table(const std::vector<ChipCost>& costs) {
    CsvTable table{{"gpu", "driver", "key", "stage"}, {}};
    for (const Figure& figure : figures()) table.columns.emplace_back(figure.name);
    table.columns.emplace_back("loop");
    table.columns.insert(table.columns.end(), kKindNames.begin(), kKindNames.end());
    for (const ChipCost& cost : costs)
        for (const KeyCost& key : cost.keys)
            for (const StageCost& stage : key.stages) {
                auto& row = table.rows.emplace_back();
                row = {std::string(cost.chip.name), cost.driver, key.key, stage.stage};
                for (const Figure& figure : figures()) row.push_back(std::to_string(stage.*figure.value));
                row.emplace_back(stage.has_loop ? "1" : "0");
                for (const std::uint64_t count : stage.kinds) row.push_back(std::to_string(count));
            }
    return table;
}

nlohmann::ordered_json to_json(const std::vector<ChipCost>& costs, bool with_assembly) {
    nlohmann::ordered_json gpus = nlohmann::ordered_json::array();
    for (const ChipCost& cost : costs) {
        nlohmann::ordered_json keys = nlohmann::ordered_json::array();
        for (const KeyCost& key : cost.keys) {
            nlohmann::ordered_json stages = nlohmann::ordered_json::array();
            for (const StageCost& stage : key.stages) {
                nlohmann::ordered_json& told = stages.emplace_back();
                told["stage"] = stage.stage;
                for (const Figure& figure : figures()) told[std::string(figure.name)] = stage.*figure.value;
                told["loop"] = stage.has_loop;
                for (std::size_t kind = 0; kind < kKindNames.size(); ++kind)
                    told["kinds"][std::string(kKindNames[kind])] = stage.kinds[kind];
                if (with_assembly) told["assembly"] = stage.assembly;
            }
            keys.push_back({{"key", key.key}, {"stages", std::move(stages)}});
        }
        gpus.push_back({{"gpu", cost.chip.name},
                        {"architecture", cost.chip.architecture},
                        {"driver", cost.driver},
                        {"permutations", std::move(keys)}});
    }
    return {{"gpus", std::move(gpus)}};
}

std::string assembly_text(const std::vector<ChipCost>& costs) {
    std::string text = "; drivers keep no lines of the source in their assembly: it is grouped by stage\n";
    for (const ChipCost& cost : costs)
        for (const KeyCost& key : cost.keys)
            for (const StageCost& stage : key.stages)
                text += fmt::format("; {}, {} stage of {}\n{}\n", cost.chip.name, stage.stage, key.key,
                                    stage.assembly);
    return text;
}

std::string percent_text(std::uint64_t before, std::uint64_t after) {
    if (before == 0) return "";
    const double percent = 100 * (static_cast<double>(after) / static_cast<double>(before) - 1);
    return fmt::format("{:+.1f} %", percent);
}

std::string kinds_text(const ByKind& before, const ByKind& after) {
    std::vector<std::string> changes;
    for (std::size_t kind = 0; kind < kKindNames.size(); ++kind)
        if (before[kind] != after[kind])
            changes.push_back(
                fmt::format("{} {:+}", kKindNames[kind], signed_difference(before[kind], after[kind])));
    return join(changes, ", ");
}

std::string difference_text(const std::vector<ChipCost>& costs, const std::string& before,
                            const std::string& after) {
    std::string text;
    for (const ChipCost& cost : costs) {
        const KeyCost* first = cost_of_key(cost, before);
        const KeyCost* second = cost_of_key(cost, after);
        if (first == nullptr || second == nullptr) continue;
        for (const StageCost& is : second->stages) {
            const auto found = std::ranges::find(first->stages, is.stage, &StageCost::stage);
            if (found == first->stages.end()) continue;  // of a key of another program
            const StageCost& was = *found;
            text += fmt::format("{}, {} stage{}\n", cost.chip.name, is.stage,
                                was.has_loop || is.has_loop ? " (loop: cycles and latency are guessed)" : "");
            for (const Figure& figure : figures()) {
                const std::uint64_t old_value = was.*figure.value;
                const std::uint64_t new_value = is.*figure.value;
                if (old_value == new_value && figure.value != &StageCost::cycles) continue;
                text +=
                    fmt::format("  {:<13}{:>6} -> {:>5}  {:+5}  {}\n", figure.title, old_value, new_value,
                                signed_difference(old_value, new_value), percent_text(old_value, new_value));
            }
            if (const std::string kinds = kinds_text(was.kinds, is.kinds); !kinds.empty())
                text += fmt::format("  instructions by kind: {}\n", kinds);
        }
    }
    return text;
}

}  // namespace gobo::cost
