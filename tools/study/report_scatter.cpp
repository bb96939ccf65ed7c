#include <algorithm>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "family/key.hpp"
#include "study/qualities.hpp"
#include "study/report_parts.hpp"

namespace gobo::study {
namespace {

/// Errors below are drawn as this: what is exact has no place on a logarithmic axis.
constexpr double kLeastShown = 1e-8;

/// The feature that colours the points: the first that says where light is computed, else the first quality.
int coloured_feature(const ReportInput& input) {
    for (const std::string& name : input.study.plan.rate)
        if (const auto feature = input.family.index_of(name)) return *feature;
    const std::vector<int> features = quality_features(input.family);
    return features.empty() ? -1 : features.front();
}

std::vector<const StudyRow*> rows_on(const ReportInput& input, const std::string& effects,
                                     const std::string& scene) {
    std::vector<const StudyRow*> rows;
    for (const StudyRow& row : input.rows)
        if (row.effects == effects && row.scene == scene) rows.push_back(&row);
    return rows;
}

std::string spread_text(const Spread& spread) {
    return fmt::format("{} ({} to {})", short_number(spread.median), short_number(spread.low),
                       short_number(spread.high));
}

std::string tip_of(const StudyRow& row) {
    std::string tip = fmt::format(
        "{}\nerror: max {}, 99.9 % {}, RMS {}\nof it rounding {}, approximation {}, shading rate {}\n"
        "cost: {} additions a fragment, {} a vertex",
        row.key, short_number(row.error.max), short_number(row.error.p999), short_number(row.error.rms),
        short_number(row.rounding.max), short_number(row.approximation.max), short_number(row.rate.max),
        short_number(row.costs.fragment), short_number(row.costs.vertex));
    if (row.timing)
        tip += fmt::format("\ntime: {} ns a fragment", spread_text(ranked_slopes(*row.timing).fragment));
    if (row.instructions)
        tip += fmt::format("\ninstructions: {} a fragment", short_number(*row.instructions));
    if (!row.dominated_by.empty()) tip += "\ndominated by " + row.dominated_by;
    return tip;
}

/// The values of the quality features, by number, for the page's filter.
std::string value_numbers(const ReportInput& input, const std::string& key_text) {
    const Key key = parse_key(input.family, key_text).value();
    std::vector<int> numbers;
    for (const int feature : quality_features(input.family))
        numbers.push_back(key[static_cast<std::size_t>(feature)]);
    return fmt::format("{}", fmt::join(numbers, " "));
}

std::string front_table(const std::vector<const StudyRow*>& rows) {
    std::vector<const StudyRow*> front;
    for (const StudyRow* row : rows)
        if (row->on_front) front.push_back(row);
    std::sort(front.begin(), front.end(), [](const StudyRow* a, const StudyRow* b) {
        return std::tuple(b->costs.total, a->key) < std::tuple(a->costs.total, b->key);
    });
    std::vector<std::vector<std::string>> cells;
    for (const StudyRow* row : front)
        cells.push_back({row->quality.empty() ? "most accurate" : row->quality, short_number(row->error.max),
                         short_number(row->error.p999), short_number(row->error.rms),
                         short_number(row->costs.total),
                         row->timing ? spread_text(ranked_slopes(*row->timing).fragment) : ""});
    return html_table({"on the front", "error, max", "99.9 %", "RMS", "cost", "ns a fragment"}, cells);
}

}  // namespace

Chart scatter_of(const ReportInput& input, const std::string& effects, const std::string& scene) {
    const std::vector<const StudyRow*> rows = rows_on(input, effects, scene);
    std::vector<double> costs;
    std::vector<double> errors;
    for (const StudyRow* row : rows) {
        costs.push_back(row->costs.total);
        errors.push_back(row->error.max);
    }
    Chart chart(fmt::format("{}, {}", effects, scene == kAllScenes ? "all scenes" : scene),
                axis_for("weighted cost of a fragment, in additions", true, costs, 1),
                axis_for("largest error, linear radiance", true, errors, kLeastShown));
    const int feature = coloured_feature(input);
    std::vector<std::pair<double, double>> front;
    std::vector<bool> used(16);
    // Dominated ones first, so that the front lies on top.
    for (const bool on_front : {false, true}) {
        for (const StudyRow* row : rows) {
            if (row->on_front != on_front) continue;
            const Key key = parse_key(input.family, row->key).value();
            const int series = feature < 0 ? 0 : key[static_cast<std::size_t>(feature)];
            used[static_cast<std::size_t>(series) % used.size()] = true;
            const std::string attributes =
                fmt::format(R"(class="point" tabindex="0" data-key="{}" data-values="{}")", escaped(row->key),
                            value_numbers(input, row->key));
            const double error = std::max(row->error.max, kLeastShown);
            chart.add(
                {row->costs.total, error, series, !on_front, on_front ? 6.0 : 4.0, attributes, tip_of(*row)});
            if (on_front) front.emplace_back(row->costs.total, error);
        }
    }
    std::sort(front.begin(), front.end());
    chart.add_steps(front);
    for (std::size_t value = 0; feature >= 0 && value < used.size(); ++value) {
        const Feature& coloured = input.family.features[static_cast<std::size_t>(feature)];
        if (used[value])
            chart.add_legend(fmt::format("{}={}", coloured.name, coloured.values[value]),
                             static_cast<int>(value));
    }
    chart.add_legend("hollow: dominated", 0, true);
    return chart;
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
                front_table(rows_on(input, effects, scene)));
        }
    }
    return text;
}

}  // namespace gobo::study
