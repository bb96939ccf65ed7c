#include "lab/cost/baseline.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::cost {
namespace {

constexpr const char* kUpdate = "write it anew with --update";

/// GPU, key and stage.
using RowName = std::array<std::string, 3>;

struct BaselineRow {
    std::string driver;
    StageCost cost;
};

Result<std::map<RowName, BaselineRow>> read_rows(const CsvTable& table, const std::string& path) {
    const auto missing = [&](std::string_view name) {
        return fail({path, 1, 0}, "", fmt::format("there is no column '{}'", name), kUpdate);
    };
    std::array<std::size_t, 4> names{};
    for (std::size_t i = 0; const char* name : {"gpu", "key", "stage", "driver"}) {
        const auto column = table.column(name);
        if (!column) return missing(name);
        names[i++] = *column;
    }
    std::map<RowName, BaselineRow> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& cells = table.rows[i];
        BaselineRow& row = rows[{cells[names[0]], cells[names[1]], cells[names[2]]}];
        row.driver = cells[names[3]];
        const auto read = [&](std::string_view name, std::uint64_t& value) -> Result<void> {
            const auto column = table.column(name);
            if (!column) return missing(name);
            const auto number = number_in_cell(cells[*column]);
            if (!number || *number < 0 || *number > 1e15)
                return fail_at_row(path, i, fmt::format("'{}' is no number of {}", cells[*column], name),
                                   kUpdate);
            value = static_cast<std::uint64_t>(*number);
            return {};
        };
        for (const Figure& figure : figures()) GOBO_TRY_DO(read(figure.name, row.cost.*figure.value));
        std::uint64_t has_loop = 0;
        GOBO_TRY_DO(read("loop", has_loop));
        row.cost.has_loop = has_loop != 0;
        for (std::size_t kind = 0; kind < kKindNames.size(); ++kind)
            GOBO_TRY_DO(read(kKindNames[kind], row.cost.kinds[kind]));
    }
    return rows;
}

/// "instructions 200 -> 260 (+30.0 %), cycles ...": what has grown too much; empty where nothing has.
std::string growth(const StageCost& before, const StageCost& now, double percent) {
    std::vector<std::string> grown;
    for (const Figure& figure : figures()) {
        const bool counts = figure.value == &StageCost::instructions ||
                            figure.value == &StageCost::vector_registers ||
                            figure.value == &StageCost::scalar_registers ||
                            (figure.value == &StageCost::cycles && !now.has_loop && !before.has_loop);
        const std::uint64_t old_value = before.*figure.value;
        const std::uint64_t new_value = now.*figure.value;
        if (!counts || static_cast<double>(new_value) <= static_cast<double>(old_value) * (1 + percent / 100))
            continue;
        const std::string rate =
            old_value == 0 ? "" : fmt::format(" ({})", percent_text(old_value, new_value));
        grown.push_back(fmt::format("{} {} -> {}{}", figure.title, old_value, new_value, rate));
    }
    return join(grown, ", ");
}

}  // namespace

Result<Comparison> compare_with_baseline(const std::vector<ChipCost>& costs, const CsvTable& baseline,
                                         const std::string& path, double percent) {
    GOBO_TRY(const auto rows, read_rows(baseline, path));
    Comparison comparison;
    std::vector<std::string> absent;
    for (const ChipCost& cost : costs)
        for (const KeyCost& key : cost.keys)
            for (const StageCost& stage : key.stages) {
                const auto found = rows.find({std::string(cost.chip.name), key.key, stage.stage});
                if (found == rows.end()) {
                    absent.push_back(
                        fmt::format("the {} stage of '{}' on {}", stage.stage, key.key, cost.chip.name));
                    continue;
                }
                const BaselineRow& row = found->second;
                if (row.driver != cost.driver)
                    return fail(
                        {path, 0, 0}, "",
                        fmt::format("its figures of {} are from {}, and here is {}: two versions' estimates "
                                    "cannot be compared",
                                    cost.chip.name, row.driver, cost.driver),
                        kUpdate);
                ++comparison.stages;
                const std::string grown = growth(row.cost, stage, percent);
                if (grown.empty()) continue;
                ++comparison.grown;
                Diagnostic& error = comparison.diagnostics.emplace_back();
                error.message =
                    fmt::format("the {} stage has grown on {}: {}", stage.stage, cost.chip.name, grown);
                error.subject = key.key;
                const std::string kinds = kinds_text(row.cost.kinds, stage.kinds);
                error.help = fmt::format("{}{}if that is meant, {}", kinds,
                                         kinds.empty() ? "" : " instructions; ", kUpdate);
            }
    if (absent.empty()) return comparison;
    if (comparison.stages == 0)
        return fail({path, 0, 0}, "",
                    fmt::format("it holds nothing of what was measured, such as {}", absent.front()),
                    kUpdate);
    comparison.diagnostics.push_back(
        {.severity = Severity::warning,
         .place = {path, 0, 0},
         .message = fmt::format("it lacks {}{}", absent.front(),
                                absent.size() == 1 ? "" : fmt::format(" and {} more", absent.size() - 1)),
         .help = kUpdate});
    return comparison;
}

}  // namespace gobo::cost
