#include "lab/study/study_csv.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/study/front.hpp"
#include "budget/qualities.hpp"
#include "lab/study/time_study.hpp"

namespace gobo::study {
namespace {

void widen(ErrorFigures& worst, const ErrorFigures& other) {
    worst.max = std::max(worst.max, other.max);
    worst.p999 = std::max(worst.p999, other.p999);
    worst.rms = std::max(worst.rms, other.rms);
}

StudyRow row_on_scene(const Measurement& measured, const Weights& weights) {
    StudyRow row;
    row.from_oracle = measured.from_oracle;
    row.pixels = measured.pixels;
    row.edges = measured.edges;
    row.error = measured.total;
    row.rounding = measured.rounding;
    row.approximation = measured.approximation;
    row.rate = measured.rate;
    row.relative = measured.relative;
    row.costs = costs_of(measured, weights);
    row.work = measured.work;
    return row;
}

/// The worst error, the mean cost.
StudyRow row_of_all(const std::vector<StudyRow>& scenes) {
    StudyRow all;
    const auto count = static_cast<double>(scenes.size());
    all.from_oracle = true;
    for (const StudyRow& row : scenes) {
        all.from_oracle = all.from_oracle && row.from_oracle;
        all.pixels += row.pixels;
        all.edges += row.edges;
        widen(all.error, row.error);
        widen(all.rounding, row.rounding);
        widen(all.approximation, row.approximation);
        widen(all.rate, row.rate);
        all.relative = std::max(all.relative, row.relative);
        all.costs.fragment += row.costs.fragment / count;
        all.costs.vertex += row.costs.vertex / count;
        all.costs.vertices_per_fragment += row.costs.vertices_per_fragment / count;
        all.costs.total += row.costs.total / count;
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind) {
            all.work.vertices[kind] += row.work.vertices[kind];
            all.work.fragments[kind] += row.work.fragments[kind];
        }
    }
    return all;
}

/// `rows` are one scene's, one for each key.
void mark_front(std::vector<StudyRow*> rows) {
    std::vector<Priced> points;
    for (const StudyRow* row : rows) points.push_back({row->costs.total, row->error.max});
    const auto by = dominators(points);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i]->on_front = !by[i];
        if (by[i]) rows[i]->dominated_by = rows[*by[i]]->key;
    }
}

/// `rows` are the timed ones over all scenes, one for each key.
void mark_time_front(const std::vector<StudyRow*>& rows) {
    for (StudyRow* row : rows) {
        const Spread own = time_of(*row);
        row->on_time_front = std::none_of(rows.begin(), rows.end(), [&](const StudyRow* other) {
            return other->error.max <= row->error.max && time_of(*other).high < own.low;
        });
    }
}

std::string counts_text(const evaluate::Counts& counts) {
    std::string text;
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        if (counts[kind] > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : " ", evaluate::kKindNames[kind], counts[kind]);
    return text;
}

/// Both clocks' slopes: nothing where the key was not timed.
std::vector<std::string> timing_cells(const StudyRow& row) {
    if (!row.timing) return std::vector<std::string>(18);
    const std::optional<Timing>& timing = row.timing;
    std::vector<std::string> cells;
    for (const Slopes* slopes : {&timing->elapsed, &timing->processor})
        for (const Spread* spread : {&slopes->fragment, &slopes->vertex})
            for (const double number : {spread->median, spread->low, spread->high})
                cells.push_back(csv_number(number));
    const Spread time = time_of(row);
    for (const double number : {time.median, time.low, time.high}) cells.push_back(csv_number(number));
    cells.push_back(row.on_time_front ? (*row.on_time_front ? "yes" : "no") : "");
    cells.push_back(std::to_string(timing->rounds));
    cells.push_back(timing->renderer);
    return cells;
}

/// The columns before the times, the times', and those after.
std::vector<std::string> columns() {
    std::vector<std::string> names = {"effects",
                                      "key",
                                      "scene",
                                      "reference",
                                      "pixels",
                                      "edges",
                                      "error_max",
                                      "error_p999",
                                      "error_rms",
                                      "error_relative",
                                      "rounding_max",
                                      "rounding_rms",
                                      "approximation_max",
                                      "approximation_rms",
                                      "rate_max",
                                      "rate_rms",
                                      "fragment_cost",
                                      "vertex_cost",
                                      "vertices_per_fragment",
                                      "cost",
                                      "front",
                                      "dominated_by"};
    for (const std::string clock : {"elapsed", "processor"})
        for (const std::string what : {"fragment", "vertex"})
            for (const std::string part : {"", "_q1", "_q3"})
                names.push_back(fmt::format("{}_ns_{}{}", what, clock, part));
    names.insert(names.end(), {"time_ns", "time_ns_q1", "time_ns_q3", "time_front", "rounds", "renderer",
                               "fragment_instructions", "fragment_operations", "vertex_operations"});
    return names;
}

}  // namespace

std::vector<StudyRow> rows_of(const Family& family, const Study& study, const Weights& weights) {
    std::vector<StudyRow> rows;
    for (const EffectsResult& effects : study.effects) {
        const std::size_t first = rows.size();
        for (const KeyResult& result : effects.keys) {
            std::vector<StudyRow> scenes;
            for (const Measurement& measured : result.scenes)
                scenes.push_back(row_on_scene(measured, weights));
            scenes.insert(scenes.begin(), row_of_all(scenes));
            scenes.front().timing = result.timing;
            scenes.front().instructions = result.instructions;
            for (std::size_t i = 0; i < scenes.size(); ++i) {
                scenes[i].effects = key_text(family, effects.effects);
                scenes[i].key = key_text(family, result.key);
                scenes[i].quality = quality_text(family, result.key);
                scenes[i].scene = i == 0 ? kAllScenes : study.scenes[i - 1];
                rows.push_back(std::move(scenes[i]));
            }
        }
        for (std::size_t scene = 0; scene <= study.scenes.size(); ++scene) {
            std::vector<StudyRow*> of_scene;
            for (std::size_t i = first + scene; i < rows.size(); i += study.scenes.size() + 1)
                of_scene.push_back(&rows[i]);
            mark_front(std::move(of_scene));
        }
        std::vector<StudyRow*> timed;
        for (std::size_t i = first; i < rows.size(); i += study.scenes.size() + 1)
            if (rows[i].timing) timed.push_back(&rows[i]);
        if (!timed.empty() && effects.control &&
            ranked_control(*effects.control, timed.front()->timing->renderer) <= kLargestControl)
            mark_time_front(timed);
    }
    return rows;
}

Spread time_of(const StudyRow& row) {
    const Slopes& slopes = ranked_slopes(*row.timing);
    const double share = row.costs.vertices_per_fragment;
    return {slopes.fragment.median + share * slopes.vertex.median,
            slopes.fragment.low + share * slopes.vertex.low,
            slopes.fragment.high + share * slopes.vertex.high};
}

std::string study_csv(const std::vector<StudyRow>& rows) {
    CsvTable table;
    table.columns = columns();
    for (const StudyRow& row : rows) {
        std::vector<std::string> cells = {row.effects,
                                          row.key,
                                          row.scene,
                                          row.from_oracle ? "oracle" : "fp64",
                                          std::to_string(row.pixels),
                                          std::to_string(row.edges)};
        for (const double number :
             {row.error.max, row.error.p999, row.error.rms, row.relative, row.rounding.max, row.rounding.rms,
              row.approximation.max, row.approximation.rms, row.rate.max, row.rate.rms, row.costs.fragment,
              row.costs.vertex, row.costs.vertices_per_fragment, row.costs.total})
            cells.push_back(csv_number(number));
        cells.push_back(row.on_front ? "yes" : "no");
        cells.push_back(row.dominated_by);
        for (std::string& cell : timing_cells(row)) cells.push_back(std::move(cell));
        cells.push_back(row.instructions ? csv_number(*row.instructions) : "");
        cells.push_back(counts_text(row.work.fragments));
        cells.push_back(counts_text(row.work.vertices));
        table.rows.push_back(std::move(cells));
    }
    return csv_text(table);
}

std::vector<StudyRow> summary_of(const Family& family, const std::vector<StudyRow>& rows) {
    std::vector<StudyRow> summary;
    for (const StudyRow& row : rows) {
        if (row.scene != kAllScenes) continue;
        const std::vector<Choice> singles = single_choices(family, parse_key(family, row.effects).value());
        const bool is_single =
            row.quality.empty() || std::any_of(singles.begin(), singles.end(), [&](const Choice& choice) {
                return key_text(family, choice.key) == row.key;
            });
        if (row.on_front || is_single) summary.push_back(row);
    }
    return summary;
}

std::string curves_csv(const std::vector<CurvePoint>& curves) {
    CsvTable table;
    table.columns = {"feature",   "value",     "over",      "number",   "effects",
                     "model_max", "model_rms", "error_max", "error_rms"};
    for (const CurvePoint& point : curves)
        table.rows.push_back({point.feature, point.value, point.over, csv_number(point.number), point.effects,
                              csv_number(point.error.max), csv_number(point.error.rms),
                              csv_number(point.total.max), csv_number(point.total.rms)});
    return csv_text(table);
}

}  // namespace gobo::study
