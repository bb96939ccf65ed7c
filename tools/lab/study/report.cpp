#include "lab/study/report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "core/text_template.hpp"
#include "family/key.hpp"
#include "lab/study/front.hpp"
#include "lab/study/html.hpp"
#include "lab/study/parallel_results.hpp"
#include "lab/study/qualities.hpp"

namespace gobo::study {
namespace {

/// The scale of heat maps' colours: logarithmic, from the least error that is told apart to the largest.
constexpr double kCoolest = 1e-6;
constexpr double kHottest = 1;
/// Their size in pixels.
constexpr int kMapWidth = 192;
constexpr int kMapHeight = 144;

/// The colour of an error: dark blue through green to yellow, brighter the larger.
Color heat_color(double error) {
    if (std::isnan(error)) error = kHottest;
    const double heat =
        std::clamp(std::log(std::max(error, kCoolest) / kCoolest) / std::log(kHottest / kCoolest), 0.0, 1.0);
    // sRGB anchors whose lightness rises evenly, so that the order shows in grey as well.
    constexpr std::array<Color, 5> kAnchors = {
        {{0.05, 0.03, 0.20}, {0.15, 0.25, 0.50}, {0.15, 0.50, 0.50}, {0.45, 0.75, 0.35}, {1.00, 0.95, 0.45}}};
    const double at = heat * (kAnchors.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), kAnchors.size() - 2);
    Color color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = linear_of_srgb(
            std::lerp(kAnchors[below][c], kAnchors[below + 1][c], at - static_cast<double>(below)));
    return color;
}

/// Colours of the scene's points as a picture; what shows no surface is grey.
template <class ColorOf>
Image picture_of(const ScenePoints& points, const ColorOf& color_of) {
    Image image(kMapWidth, kMapHeight, 4);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = i % 4 == 3 ? 1.0F : 0.2F;
    for (std::size_t o = 0; o < points.objects.size(); ++o) {
        for (std::size_t i = 0; i < points.objects[o].fragments.size(); ++i) {
            const raster::Fragment& fragment = points.objects[o].fragments[i];
            const Color color = color_of(o, i);
            std::copy(color.begin(), color.end(), &image.at(fragment.x, kMapHeight - 1 - fragment.y, 0));
        }
    }
    return image;
}

Result<HeatMap> heat_map(const Family& family, const ScenePoints& points, const Variant& variant) {
    GOBO_TRY(const Colors colors, shade_points<float>(points, variant));
    HeatMap map;
    map.quality = quality_text(family, variant.key);
    map.image = picture_of(points, [&](std::size_t o, std::size_t i) {
        const Color& a = colors[o][i];
        const Color& b = points.objects[o].reference[i];
        const double error = std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
        map.largest = std::max(map.largest, error);
        return heat_color(error);
    });
    return map;
}

std::string ratio_text(double ratio) {
    return "\u00d7 " + fmt::format("{:.2f}", ratio);
}

std::string percent(double part) {
    return fmt::format("{:.1f} %", 100 * part);
}

std::vector<const StudyRow*> rows_on(const ReportInput& input, const std::string& effects,
                                     const std::string& scene) {
    std::vector<const StudyRow*> rows;
    for (const StudyRow& row : input.rows)
        if (row.effects == effects && row.scene == scene) rows.push_back(&row);
    return rows;
}

/// The scatter of one combination of effects on one scene.
Chart scatter_of(const ReportInput& input, const std::string& effects, const std::string& scene) {
    return front_chart(input.family, input.study.plan.rate, rows_on(input, effects, scene),
                       fmt::format("{}, {}", effects, scene == kAllScenes ? "all scenes" : scene));
}

/// Times only where some were measured.
std::string table_of_front(const std::vector<const StudyRow*>& rows) {
    const std::vector<const StudyRow*> front = front_of(rows);
    const bool is_timed =
        std::any_of(front.begin(), front.end(), [](const auto* row) { return row->timing.has_value(); });
    std::vector<std::string> header = {"", "on the front", "error, max", "99.9 %", "RMS", "cost, additions"};
    if (is_timed) header.insert(header.end(), {"time, ns", "front by time"});
    std::vector<HtmlRow> lines;
    for (const StudyRow* row : front) {
        std::vector<std::string> cells = {
            std::to_string(lines.size() + 1), row->quality.empty() ? "most accurate" : row->quality,
            short_number(row->total.max),     short_number(row->total.p999),
            short_number(row->total.rms),     short_number(row->costs.total)};
        if (is_timed) {
            cells.push_back(row->timing ? spread_text(row->time()) : "");
            cells.push_back(row->on_time_front ? (*row->on_time_front ? "yes" : "no") : "");
        }
        lines.push_back({std::move(cells)});
    }
    return html_table(header, lines);
}

/// Every scatter as a figure, the first one shown, each with the table of its front.
std::string scatter_figures(const ReportInput& input) {
    std::string text;
    std::vector<std::string> scenes = {kAllScenes};
    scenes.insert(scenes.end(), input.study.scenes.begin(), input.study.scenes.end());
    for (const EffectsResult& result : input.study.effects) {
        const std::string effects = key_text(input.family, result.effects);
        for (const std::string& scene : scenes)
            text += fmt::format(
                "<figure data-effects=\"{}\" data-scene=\"{}\"{}>\n{}<figcaption>{} of {} permutations of "
                "these effects measured.</figcaption>\n{}</figure>\n",
                html_escaped(effects), html_escaped(scene), text.empty() ? "" : " hidden",
                scatter_of(input, effects, scene).svg(), result.keys.size(), result.considered,
                table_of_front(rows_on(input, effects, scene)));
    }
    return text;
}

Chart curve_chart(const std::vector<const CurvePoint*>& points) {
    constexpr double kLeast = 1e-8;
    std::vector<double> numbers;
    std::vector<double> errors;
    std::vector<std::string> values;
    for (const CurvePoint* point : points) {
        numbers.push_back(point->number);
        errors.push_back(point->total.rms);
        if (std::find(values.begin(), values.end(), point->value) == values.end())
            values.push_back(point->value);
    }
    const CurvePoint& first = *points.front();
    const std::string along =
        first.over == "slices" ? "slices of the sphere (half as many stacks)" : first.over;
    Chart chart(fmt::format("{}: {}", first.feature, first.effects), axis_for(along, numbers, 1e-3),
                axis_for("RMS error, linear radiance", errors, kLeast));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int series = static_cast<int>(i);
        std::vector<std::pair<double, double>> line;
        for (const CurvePoint* point : points) {
            if (point->value != values[i]) continue;
            line.emplace_back(point->number, std::max(point->total.rms, kLeast));
            chart.add({point->number, line.back().second, series, false, 4, "",
                       fmt::format("{}={} at {}: RMS {}, max {}", first.feature, values[i],
                                   short_number(point->number), short_number(point->total.rms),
                                   short_number(point->total.max))});
        }
        chart.add_line(line, series);
        chart.add_legend(values[i], series);
    }
    return chart;
}

/// One for each feature and what it is measured along, by name: "curve.shading.slices.svg".
std::map<std::string, std::string> curve_charts(const ReportInput& input) {
    std::map<std::string, std::vector<const CurvePoint*>> curves;
    for (const CurvePoint& point : input.study.curves)
        curves[fmt::format("curve.{}.{}.svg", point.feature, point.over)].push_back(&point);
    std::map<std::string, std::string> charts;
    for (const auto& [name, points] : curves) charts[name] = curve_chart(points).svg();
    return charts;
}

std::string choices_table(const ReportInput& input) {
    std::vector<HtmlRow> rows;
    for (const ChoiceSummary& choice : summarise_choices(input.family, input.study, input.weights)) {
        if (choice.combinations == 0) continue;
        std::string verdict = choice.is_excluded ? "excluded by default; " : "";
        if (!choice.dominated_by.empty())
            verdict +=
                fmt::format("dominated everywhere by {} ({} comparisons)", choice.dominated_by, choice.pairs);
        else if (choice.is_most_accurate)
            verdict += "most accurate";
        const std::string most =
            choice.least_cost == choice.most_cost ? "" : fmt::format(" to {:.2f}", choice.most_cost);
        rows.push_back({{choice.feature, choice.value, short_number(choice.error_max),
                         short_number(choice.error_rms), ratio_text(choice.least_cost) + most, verdict},
                        choice.dominated_by.empty() ? "" : "dominated"});
    }
    return html_table({"feature", "value", "error, max", "RMS", "cost", ""}, rows);
}

std::string changes_section(const ReportInput& input) {
    if (input.study.changes.empty()) return "";
    std::vector<HtmlRow> rows;
    for (const ChangeResult& result : input.study.changes)
        rows.push_back({{result.change.from, result.change.to, short_number(result.difference.max),
                         short_number(result.difference.rms), short_number(result.largest)}});
    return "<h2 id=\"changes\">Changes of model</h2>\n<p>Both exact: no error of either, but another look. "
           "The exponents are matched as the plan says.</p>\n" +
           html_table({"from", "to", "difference, max", "RMS", "brightest"}, rows);
}

std::string guards_section(const ReportInput& input) {
    const CsvTable table = read_csv(input.guard_prices);
    std::string renderer;
    std::vector<HtmlRow> rows;
    for (const std::vector<std::string>& row : table.rows) {
        const auto cell = [&](const std::string& name) {
            const auto index = table.column(name);
            return index ? row[*index] : "";
        };
        const auto spread = [&](const std::string& name) {
            const auto end = [&](const char* part) {
                return number_from<double>(cell(name + part)).value_or(0);
            };
            return Spread{end(""), end("_low"), end("_high")};
        };
        const Spread guarded = spread("guarded_us");
        const Spread plain = spread("plain_us");
        rows.push_back({{cell("guard"), cell("key"),
                         fmt::format("{} ({})", cell("operations_guarded"), cell("operations_plain")),
                         spread_text(guarded), spread_text(plain),
                         guarded.overlaps(plain) ? "\u2014" : ratio_text(guarded.median / plain.median)}});
        if (renderer.empty()) renderer = cell("renderer");
    }
    if (rows.empty()) return "";
    return fmt::format(
               "<h2 id=\"guards\">What guards cost</h2>\n"
               "<p>What keeps hard inputs from undefined operations, with each guard and without it: "
               "operations of an invocation, and microseconds of a draw (median, middle half) on {}. A dash: "
               "no measurable difference. Rows of docs/data/guard_prices.csv.</p>\n",
               html_escaped(renderer)) +
           html_table({"guard", "in", "operations (without)", "time, \u00b5s", "without", "ratio"}, rows);
}

Result<std::string> map_figures(const ReportInput& input) {
    std::string text;
    for (const HeatMap& map : input.maps) {
        GOBO_TRY(const std::string png, encode_image(map.image, ImageFormat::png));
        const std::string caption =
            map.quality.empty() ? "the scene: " + input.study.plan.quick.back()
                                : fmt::format("{}: at most {}", map.quality, short_number(map.largest));
        text += fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                            html_escaped(caption), data_url("image/png", png));
    }
    return text;
}

std::string heat_scale() {
    std::string stops;
    for (int i = 0; i <= 12; ++i) {
        const Color color = heat_color(kCoolest * std::pow(kHottest / kCoolest, i / 12.0));
        stops += fmt::format("{}rgb({:.0f} {:.0f} {:.0f})", i > 0 ? "," : "", 255 * srgb_of_linear(color[0]),
                             255 * srgb_of_linear(color[1]), 255 * srgb_of_linear(color[2]));
    }
    return fmt::format(
        "{} <span class=\"scale\" style=\"background:linear-gradient(to right,{})\"></span> {}",
        short_number(kCoolest), stops, short_number(kHottest));
}

const Timing* any_timing(const Study& study) {
    for (const EffectsResult& effects : study.effects)
        for (const KeyResult& key : effects.keys)
            if (key.timing) return &*key.timing;
    return nullptr;
}

/// One row for each combination: its control, and how many keys cannot be told from the most accurate one.
std::string control_table(const ReportInput& input, const std::string& renderer) {
    std::vector<HtmlRow> rows;
    for (const EffectsResult& effects : input.study.effects) {
        if (!effects.control) continue;
        std::size_t timed = 0;
        std::size_t alike = 0;
        const Spread& accurate = effects.keys.front().timing->ranked().fragment;
        for (const KeyResult& key : effects.keys) {
            if (!key.timing || &key == &effects.keys.front()) continue;
            ++timed;
            if (key.timing->ranked().fragment.overlaps(accurate)) ++alike;
        }
        rows.push_back(
            {{key_text(input.family, effects.effects), percent(effects.control->elapsed),
              percent(effects.control->processor),
              effects.control->ranked(renderer) <= kLargestControl
                  ? fmt::format("{} of {} show no measurable difference from the most accurate", alike, timed)
                  : "off by more than 2 %: nothing is ranked by time"}});
    }
    return html_table({"effects", "A/A, elapsed", "A/A, processor", "fragments"}, rows);
}

/// The cost of fragments, or of vertices, against their time.
std::string correlation_text(const ReportInput& input, bool of_vertices, bool by_processor) {
    constexpr double kGoodCorrelation = 0.9;  // that a weighted cost should reach to stand for time
    const CostAndTime points = cost_against_time(input.study, input.weights, of_vertices);
    const std::string what = of_vertices ? "vertex" : "fragment";
    Chart chart(fmt::format("Cost against time of a {}", what),
                axis_for(fmt::format("weighted cost of a {}, in additions", what), points.cost, 1),
                axis_for(fmt::format("{} time of a {}, ns", by_processor ? "processor" : "elapsed", what),
                         points.nanoseconds, 0.1),
                560, 360);
    for (std::size_t i = 0; i < points.cost.size(); ++i)
        chart.add({points.cost[i], points.nanoseconds[i], 0, true, 4, "",
                   fmt::format("{} additions, {} ns", short_number(points.cost[i]),
                               short_number(points.nanoseconds[i]))});
    const char* why_not = "";
    if (points.correlation < kGoodCorrelation)
        why_not =
            of_vertices
                ? ", below 0.9: where light is computed per fragment, vertex stages are all but the same, "
                  "and what a vertex costs besides its operations (fetching, clipping, setting up) "
                  "outweighs them; ranks among such equals are chance. Shading rates, whose vertex stages "
                  "do differ, are told apart"
                : ", below 0.9: the kinds that are counted do not tell apart what the renderer's compiler "
                  "merges or leaves out, or the machine was too busy";
    return chart.svg() +
           fmt::format("<p>Rank correlation of cost and time of a {}: {:.2f} over {} permutations{}.</p>\n",
                       what, points.correlation, points.cost.size(), why_not);
}

std::string time_section(const ReportInput& input) {
    const Timing* timing = any_timing(input.study);
    if (timing == nullptr)
        return "<p>This study has no times: it was made with --quick or --no-time. Costs are counts of "
               "executed operations, which repeat exactly.</p>\n";
    const bool by_processor = draws_in_calling_thread(timing->renderer);
    return fmt::format(
               "<p>Measured on {}{}. A permutation's time is the slope between two sizes (fragments) or two "
               "tessellations (vertices): median and middle half of {} interleaved rounds, each in another "
               "order. A second copy of the most accurate program is the A/A control. Ranges that overlap "
               "are no measurable difference.</p>\n",
               html_escaped(timing->renderer),
               input.computer.empty() ? "" : ", " + html_escaped(input.computer), timing->rounds) +
           control_table(input, timing->renderer) + correlation_text(input, false, by_processor) +
           correlation_text(input, true, by_processor);
}

/// What the page's own text states of the study.
void add_facts(const ReportInput& input, TemplateValues& values) {
    std::size_t permutations = 0;
    for (const EffectsResult& effects : input.study.effects) permutations += effects.keys.size();
    values["permutations"] = std::to_string(permutations);
    values["combinations"] = std::to_string(input.study.effects.size());
    values["scenes"] = std::to_string(input.study.scenes.size());
    values["command"] = html_escaped(input.command);
    values["sample_size"] = fmt::format("{} x {}", kSampleWidth, kSampleHeight);
    values["full_size"] = fmt::format("{} x {}", kFullWidth, kFullHeight);
    values["weights_renderer"] = html_escaped(input.weights.renderer);
    values["addition"] = short_number(input.weights.nanoseconds);
    std::vector<HtmlRow> rows;
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        if (const double weight = input.weights.by_kind[kind]; weight > 0)
            rows.push_back({{std::string(evaluate::kKindNames[kind]), short_number(weight)}});
    values["weights"] = html_table({"operation", "weight"}, rows);
}

/// What the page's filters offer. Features go by their number among the quality features, as the points state
/// their values.
void add_options(const ReportInput& input, TemplateValues& values) {
    values["scene_options"] = html_option(kAllScenes, "all: worst error, mean cost");
    for (const std::string& scene : input.study.scenes) values["scene_options"] += html_option(scene, scene);
    for (const EffectsResult& result : input.study.effects) {
        const std::string effects = key_text(input.family, result.effects);
        values["effects_options"] += html_option(effects, effects);
    }
    values["feature_options"] = html_option("", "any feature");
    nlohmann::ordered_json features = nlohmann::ordered_json::array();
    for (const int index : quality_features(input.family)) {
        const Feature& feature = input.family.features[static_cast<std::size_t>(index)];
        values["feature_options"] += html_option(std::to_string(features.size()), feature.name);
        features.push_back({{"name", feature.name}, {"values", feature.values}});
    }
    values["features"] = html_script(features.dump());
}

}  // namespace

Result<std::vector<HeatMap>> draw_heat_maps(const Subject& subject, const StudyPlan& plan) {
    const Family& family = subject.family;
    GOBO_TRY(const DrawnScene scene,
             draw_scene(subject.shipped, family, plan.scenes.front(), kMapWidth, kMapHeight));
    GOBO_TRY(const Key effects, parse_key(family, plan.quick.back()));
    const std::vector<Choice> choices = single_choices(family, effects);
    std::vector<Key> keys = {most_accurate(family, effects)};
    for (const Choice& choice : choices) keys.push_back(choice.key);
    GOBO_TRY(const Variants variants, load_variants(subject, keys));
    GOBO_TRY(const ScenePoints points, find_points(family, variants.at(keys.front()), scene));
    GOBO_TRY(std::vector<HeatMap> maps, parallel_results(subject.jobs, choices.size(), [&](std::size_t i) {
                 return heat_map(family, points, variants.at(choices[i].key));
             }));
    const auto reference = [&](std::size_t o, std::size_t i) { return points.objects[o].reference[i]; };
    maps.insert(maps.begin(), {"", 0, picture_of(points, reference)});
    return maps;
}

Result<std::map<std::string, std::string>> make_report(const FileSystem& shipped, const ReportInput& input) {
    const std::string folder = "templates/study/";
    TextTemplate page{folder + "report.html", {}};
    TemplateValues values;
    GOBO_TRY(page.text, shipped.read(page.name));
    GOBO_TRY(values["style"], shipped.read(folder + "report.css"));
    GOBO_TRY(values["script"], shipped.read(folder + "report.js"));
    GOBO_TRY(values["maps"], map_figures(input));
    std::map<std::string, std::string> files = curve_charts(input);
    for (const auto& [name, svg] : files) values["curves"] += "<figure>" + svg + "</figure>\n";
    if (files.empty()) values["curves"] = "<p>None was measured.</p>\n";
    add_options(input, values);
    add_facts(input, values);
    values["title"] = "What accuracy costs: " + html_escaped(input.family.name);
    values["scatters"] = scatter_figures(input);
    values["choices"] = choices_table(input);
    values["heat_scale"] = heat_scale();
    values["time"] = time_section(input);
    values["changes"] = changes_section(input);
    values["guards"] = guards_section(input);
    GOBO_TRY(files["index.html"], fill(page, values));
    const std::string shown = key_text(input.family, input.study.effects.back().effects);
    files["front.svg"] = scatter_of(input, shown, kAllScenes).svg();
    return files;
}

}  // namespace gobo::study
