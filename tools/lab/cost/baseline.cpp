#include "lab/cost/baseline.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"
#include "lab/cost/chips.hpp"

namespace gobo::cost {
namespace {

constexpr const char* kUpdate = "write it anew with --update";

constexpr std::array kNames = {"gpu", "key", "stage", "driver"};

/// GPU, key and stage.
using RowName = std::array<std::string, 3>;

struct BaselineRow {
    std::string driver;
    StageCost cost;
};

/// "the fragment stage of 'point=1' on navi21"
std::string text_of(const RowName& row) {
    return fmt::format("the {} stage of '{}' on {}", row[2], row[1], row[0]);
}

Result<std::map<RowName, BaselineRow>> read_rows(const CsvTable& table, const std::string& path) {
    const auto missing = [&](std::string_view name, const char* help) {
        return fail({path, 1, 0}, "", fmt::format("there is no column '{}'", name), help);
    };
    std::array<std::size_t, kNames.size()> names{};
    for (std::size_t i = 0; const char* name : kNames) {
        const auto column = table.column(name);
        if (!column) return missing(name, "name a table that --update wrote");
        names[i++] = *column;
    }
    std::map<RowName, BaselineRow> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& cells = table.rows[i];
        const auto unknown = [&](std::string_view what, const std::string& cell) {
            return fail_at_row(path, i, fmt::format("'{}' is no {}", cell, what), kUpdate);
        };
        const RowName row_name = {cells[names[0]], cells[names[1]], cells[names[2]]};
        if (std::ranges::find(chips(), row_name[0], &Chip::name) == chips().end())
            return unknown("GPU that gobo knows", row_name[0]);
        if (row_name[2] != "vertex" && row_name[2] != "fragment" && row_name[2] != "compute")
            return unknown("stage that is costed", row_name[2]);
        const auto [at, is_new] = rows.try_emplace(row_name);
        if (!is_new)
            return fail_at_row(path, i, fmt::format("{} is here a second time", text_of(row_name)), kUpdate);
        BaselineRow& row = at->second;
        row.driver = cells[names[3]];
        const auto read = [&](std::string_view name, std::uint64_t& value) -> Result<void> {
            const auto column = table.column(name);
            if (!column) return missing(name, kUpdate);
            const auto number = number_from<std::uint64_t>(cells[*column]);
            if (!number)
                return fail_at_row(
                    path, i, fmt::format("'{}' is no whole number of {}", cells[*column], name), kUpdate);
            value = *number;
            return {};
        };
        for (const Figure& figure : figures()) GOBO_TRY_DO(read(figure.name, row.cost.*figure.value));
        std::uint64_t has_loop = 0;
        GOBO_TRY_DO(read("loop", has_loop));
        if (has_loop > 1)
            return unknown("answer to whether there is a loop, 0 or 1", std::to_string(has_loop));
        row.cost.has_loop = has_loop != 0;
        for (std::size_t kind = 0; kind < kKindNames.size(); ++kind)
            GOBO_TRY_DO(read(kKindNames[kind], row.cost.kinds[kind]));
    }
    return rows;
}

/// "the fragment stage of 'point=1' on navi21 and 3 more"
std::string text_of(const std::vector<RowName>& rows) {
    return text_of(rows.front()) + (rows.size() == 1 ? "" : fmt::format(" and {} more", rows.size() - 1));
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

bool is_baseline(const CsvTable& table) {
    return std::ranges::all_of(kNames, [&](const char* name) { return table.column(name).has_value(); });
}

Result<Comparison> compare_with_baseline(const std::vector<ChipCost>& costs, const CsvTable& baseline,
                                         const std::string& path, double percent) {
    GOBO_TRY(auto rows, read_rows(baseline, path));  // those that are left at the end were not measured
    Comparison comparison;
    std::vector<RowName> absent;
    for (const ChipCost& cost : costs)
        for (const KeyCost& key : cost.keys)
            for (const StageCost& stage : key.stages) {
                const RowName name = {std::string(cost.chip.name), key.key, stage.stage};
                const auto found = rows.extract(name);
                if (found.empty()) {
                    absent.push_back(name);
                    continue;
                }
                const BaselineRow& row = found.mapped();
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
    if (!absent.empty() && comparison.stages == 0)
        return fail({path, 0, 0}, "",
                    fmt::format("it holds nothing of what was measured, such as {}", text_of(absent.front())),
                    kUpdate);
    if (!absent.empty())
        comparison.diagnostics.push_back(
            {.place = {path, 0, 0}, .message = fmt::format("it lacks {}", text_of(absent)), .help = kUpdate});
    std::vector<RowName> unmeasured;
    for (const auto& [name, row] : rows) unmeasured.push_back(name);
    if (!unmeasured.empty())
        comparison.diagnostics.push_back(
            {.severity = Severity::note,
             .place = {path, 0, 0},
             .message = fmt::format("it also holds what was not measured now: {}", text_of(unmeasured))});
    return comparison;
}

std::size_t rows_lost(const CsvTable& baseline, const CsvTable& now) {
    const auto names_in = [](const CsvTable& table) {
        std::set<RowName> names;
        const auto gpu = table.column("gpu");
        const auto key = table.column("key");
        const auto stage = table.column("stage");
        if (gpu && key && stage)
            for (const auto& cells : table.rows) names.insert({cells[*gpu], cells[*key], cells[*stage]});
        return names;
    };
    const auto kept = names_in(now);
    std::set<RowName> names = names_in(baseline);
    return std::erase_if(names, [&](const RowName& name) { return !kept.contains(name); });
}

}  // namespace gobo::cost
