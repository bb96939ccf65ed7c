#include "lab/cost/study_cycles.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::cost {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// A column of that name, added where there is none.
std::size_t column_of(CsvTable& table, const std::string& name) {
    if (const auto found = table.column(name)) return *found;
    table.columns.push_back(name);
    for (auto& row : table.rows) row.emplace_back();
    return table.columns.size() - 1;
}

/// "arithmetic 40 move 3": the instructions of the fragment stage by kind.
std::string instructions_text(const KeyCost& key) {
    std::vector<std::string> texts;
    for (const StageCost& stage : key.stages)
        for (std::size_t kind = 0; stage.stage == "fragment" && kind < kKindNames.size(); ++kind)
            if (stage.kinds[kind] > 0)
                texts.push_back(fmt::format("{} {}", kKindNames[kind], stage.kinds[kind]));
    return join(texts, " ");
}

/// Cycles of 64 fragments and of so many vertices to each; kNone where they cannot be ranked.
double cycles_of(const KeyCost& key, double vertices_per_fragment) {
    double cycles = 0;
    for (const StageCost& stage : key.stages) {
        if (stage.has_loop) return kNone;
        const double share = stage.stage == "vertex" ? vertices_per_fragment : 1;
        cycles += share * static_cast<double>(stage.cycles);
    }
    return cycles;
}

}  // namespace

CsvTable with_cycles(CsvTable study, const std::vector<ChipCost>& costs) {
    std::array<std::size_t, kStudyColumns.size()> columns{};
    for (std::size_t i = 0; i < columns.size(); ++i)
        columns[i] = column_of(study, std::string(kStudyColumns[i]));
    const auto [effects_at, key_at, scene_at, error_at, vertices_at] = columns;
    for (const ChipCost& cost : costs) {
        const std::size_t cycles_at = column_of(study, fmt::format("cycles_{}", cost.chip.name));
        const std::size_t front_at = column_of(study, fmt::format("front_{}", cost.chip.name));
        const std::size_t driver_at = column_of(study, fmt::format("driver_{}", cost.chip.name));
        const std::size_t instructions_at = column_of(study, fmt::format("instructions_{}", cost.chip.name));
        std::map<std::string, const KeyCost*> by_key;
        for (const KeyCost& key : cost.keys) by_key[key.key] = &key;
        struct Point {
            std::size_t row = 0;
            double error = kNone;
            double cycles = kNone;
        };
        std::map<std::pair<std::string, std::string>, std::vector<Point>> fronts;  // by effects and scene
        for (std::size_t i = 0; i < study.rows.size(); ++i) {
            auto& row = study.rows[i];
            row[cycles_at] = row[front_at] = row[instructions_at] = "";
            row[driver_at] = fmt::format("{}, {}", cost.chip.architecture, cost.driver);
            const auto key = by_key.find(row[key_at]);
            if (key == by_key.end()) continue;
            row[instructions_at] = instructions_text(*key->second);
            const double cycles = cycles_of(*key->second, number_from<double>(row[vertices_at]).value_or(0));
            if (cycles == kNone) continue;
            row[cycles_at] = fmt::format("{:.1f}", cycles);
            fronts[{row[effects_at], row[scene_at]}].push_back(
                {i, number_from<double>(row[error_at]).value_or(kNone), cycles});
        }
        for (const auto& [which, points] : fronts)
            for (const Point& point : points) {
                const bool is_beaten = std::any_of(points.begin(), points.end(), [&](const Point& other) {
                    return other.error <= point.error && other.cycles <= point.cycles &&
                           (other.error < point.error || other.cycles < point.cycles);
                });
                study.rows[point.row][front_at] = is_beaten ? "no" : "yes";
            }
    }
    return study;
}

CsvTable summary_of(const CsvTable& study, const CsvTable& summary) {
    const auto name_of = [](const CsvTable& table, const std::vector<std::string>& row) {
        std::array<std::string, 3> name;
        for (std::size_t i = 0; i < name.size(); ++i) name[i] = row[table.column(kStudyColumns[i]).value()];
        return name;
    };
    std::set<std::array<std::string, 3>> wanted;
    std::set<std::string> scenes;
    for (const auto& row : summary.rows) {
        wanted.insert(name_of(summary, row));
        scenes.insert(name_of(summary, row)[2]);
    }
    CsvTable chosen{study.columns, {}};
    for (const auto& row : study.rows) {
        bool on_front = false;
        for (std::size_t i = 0; i < row.size(); ++i)
            on_front = on_front || (study.columns[i].starts_with("front_") && row[i] == "yes");
        const auto name = name_of(study, row);
        if (wanted.contains(name) || (on_front && scenes.contains(name[2]))) chosen.rows.push_back(row);
    }
    return chosen;
}

}  // namespace gobo::cost
