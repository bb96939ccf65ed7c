#include <algorithm>

#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/study/front_chart.hpp"
#include "lab/study/front_table.hpp"
#include "lab/study/report_parts.hpp"

namespace gobo::study {
namespace {

std::vector<const StudyRow*> rows_on(const ReportInput& input, const std::string& effects,
                                     const std::string& scene) {
    std::vector<const StudyRow*> rows;
    for (const StudyRow& row : input.rows)
        if (row.effects == effects && row.scene == scene) rows.push_back(&row);
    return rows;
}

/// Times only where some were measured.
std::string table_of_front(const std::vector<const StudyRow*>& rows) {
    const std::vector<const StudyRow*> front = front_of(rows);
    const bool is_timed =
        std::any_of(front.begin(), front.end(), [](const auto* row) { return row->timing.has_value(); });
    std::vector<std::string> header = {"", "on the front", "error, max", "99.9 %", "RMS", "cost, additions"};
    if (is_timed) header.insert(header.end(), {"time, ns", "front by time"});
    std::vector<std::vector<std::string>> cells;
    for (std::size_t i = 0; i < front.size(); ++i) {
        const StudyRow& row = *front[i];
        cells.push_back({std::to_string(i + 1), row.quality.empty() ? "most accurate" : row.quality,
                         short_number(row.error.max), short_number(row.error.p999),
                         short_number(row.error.rms), short_number(row.costs.total)});
        if (is_timed) cells.back().push_back(row.timing ? spread_text(time_of(row)) : "");
        if (is_timed) cells.back().push_back(row.on_time_front ? (*row.on_time_front ? "yes" : "no") : "");
    }
    return html_table(header, cells);
}

}  // namespace

Chart scatter_of(const ReportInput& input, const std::string& effects, const std::string& scene) {
    return front_chart(input.family, input.study.plan.rate, rows_on(input, effects, scene),
                       fmt::format("{}, {}", effects, scene == kAllScenes ? "all scenes" : scene));
}

std::string scatter_figures(const ReportInput& input) {
    std::string text;
    std::vector<std::string> scenes = {kAllScenes};
    scenes.insert(scenes.end(), input.study.scenes.begin(), input.study.scenes.end());
    for (const EffectsResult& result : input.study.effects) {
        const std::string effects = key_text(input.family, result.effects);
        for (const std::string& scene : scenes) {
            text += fmt::format(
                "<figure data-effects=\"{}\" data-scene=\"{}\"{}>\n{}<figcaption>{} of {} permutations of "
                "these "
                "effects measured.</figcaption>\n{}</figure>\n",
                escaped(effects), escaped(scene), text.empty() ? "" : " hidden",
                scatter_of(input, effects, scene).svg(), result.keys.size(), result.considered,
                table_of_front(rows_on(input, effects, scene)));
        }
    }
    return text;
}

}  // namespace gobo::study
