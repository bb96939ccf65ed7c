#include "lab/study/chip_fronts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/study/html.hpp"
#include "lab/study/qualities.hpp"

namespace gobo::study {
namespace {

/// Costs nearer to each other than this are the same: so much is a guess of any compiler's.
constexpr double kSame = 0.005;
constexpr double kLeastError = 1e-8;  ///< what is exact has no place on a logarithmic axis

/// Of one combination of effects on one scene.
using Group = std::vector<const StudyRow*>;

std::vector<Group> groups_of(const std::vector<StudyRow>& rows) {
    std::vector<Group> groups;
    std::map<std::pair<std::string, std::string>, std::size_t> numbers;
    for (const StudyRow& row : rows) {
        const auto [number, is_new] = numbers.try_emplace({row.effects, row.scene}, groups.size());
        if (is_new) groups.emplace_back();
        groups[number->second].push_back(&row);
    }
    return groups;
}

/// Those over all scenes.
std::vector<Group> whole_groups(const std::vector<StudyRow>& rows) {
    std::vector<Group> groups = groups_of(rows);
    std::erase_if(groups, [](const Group& group) { return group.front()->scene != kAllScenes; });
    return groups;
}

/// The dearer, the more accurate on a front.
std::vector<const StudyRow*> front_by(const Group& rows, const Measure& measure) {
    std::vector<const StudyRow*> front;
    for (const StudyRow* row : rows)
        if (measure.on_front(*row)) front.push_back(row);
    std::sort(front.begin(), front.end(), [&](const StudyRow* a, const StudyRow* b) {
        return std::tuple(*measure.cost(*b), a->key) < std::tuple(*measure.cost(*a), b->key);
    });
    return front;
}

/// What is on any front, the dearest by the first measure first.
std::vector<const StudyRow*> on_any_front(const Group& rows, const std::vector<Measure>& measures) {
    std::vector<const StudyRow*> found;
    for (const StudyRow* row : rows)
        if (std::any_of(measures.begin(), measures.end(),
                        [&](const Measure& measure) { return measure.on_front(*row); }))
            found.push_back(row);
    std::sort(found.begin(), found.end(), [](const StudyRow* a, const StudyRow* b) {
        return std::tuple(b->costs.total, a->key) < std::tuple(a->costs.total, b->key);
    });
    return found;
}

const StudyRow* most_accurate_of(const Group& rows) {
    const auto found = std::find_if(rows.begin(), rows.end(), [](auto* row) { return row->quality.empty(); });
    return found == rows.end() ? nullptr : *found;
}

double middle(std::vector<double> numbers) {
    return spread_of(std::move(numbers)).median;
}

/// "x0.95", or a dash where nothing was compared.
std::string ratio_cell(const std::vector<double>& ratios) {
    return ratios.empty() ? "\u2013" : fmt::format("\u00d7{:.2f}", middle(ratios));
}

std::string markdown_row(const std::vector<std::string>& cells) {
    return "| " + join(cells, " | ") + " |\n";
}

std::string markdown_header(const std::vector<std::string>& cells) {
    std::string line = markdown_row(cells) + "|";
    for (std::size_t i = 0; i < cells.size(); ++i) line += "---|";
    return line + "\n";
}

/// One value against another one of the same feature, over all rows that differ in nothing else.
struct Comparison {
    std::vector<std::vector<double>> ratios;  ///< by measure
    /// Instructions more, by the number of the measure and kind.
    std::map<std::pair<std::size_t, std::string>, std::vector<double>> instructions;
    std::size_t pairs = 0;
};

void compare(const StudyRow& one, const StudyRow& other, const std::vector<Measure>& measures,
             Comparison& comparison) {
    ++comparison.pairs;
    comparison.ratios.resize(measures.size());
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const auto cost = measures[i].cost(one);
        const auto other_cost = measures[i].cost(other);
        if (cost && other_cost && *other_cost > 0) comparison.ratios[i].push_back(*cost / *other_cost);
        const ChipRow* chip = measures[i].chip(one);
        const ChipRow* other_chip = measures[i].chip(other);
        if (chip == nullptr || other_chip == nullptr) continue;
        std::set<std::string> kinds;
        for (const auto* counts : {&chip->instructions, &other_chip->instructions})
            for (const auto& [kind, count] : *counts) kinds.insert(kind);
        const auto count_in = [](const ChipRow& counted, const std::string& kind) {
            const auto found = counted.instructions.find(kind);
            return found == counted.instructions.end() ? 0 : found->second;
        };
        for (const std::string& kind : kinds)
            comparison.instructions[{i, kind}].push_back(count_in(*chip, kind) - count_in(*other_chip, kind));
    }
}

/// By two values' numbers, the first not the second.
using Comparisons = std::map<std::pair<int, int>, Comparison>;

Comparisons comparisons_of(const Family& family, const std::vector<StudyRow>& rows,
                           const std::vector<Measure>& measures, std::size_t feature) {
    Comparisons comparisons;
    for (const Group& group : whole_groups(rows)) {
        std::map<Key, std::vector<std::pair<int, const StudyRow*>>> alike;
        for (const StudyRow* row : group) {
            Key others = parse_key(family, row->key).value();
            const int value = std::exchange(others[feature], 0);
            alike[others].emplace_back(value, row);
        }
        for (const auto& [others, values] : alike)
            for (const auto& [value, row] : values)
                for (const auto& [other_value, other] : values)
                    if (value != other_value)
                        compare(*row, *other, measures, comparisons[{value, other_value}]);
    }
    return comparisons;
}

/// -1: the first is cheaper, 1: dearer, 0: neither, or nothing is known.
int order_of(const std::vector<double>& ratios) {
    if (ratios.empty()) return 0;
    const double ratio = middle(ratios);
    return ratio < 1 - kSame ? -1 : ratio > 1 + kSame ? 1 : 0;
}

/// "navi21: arithmetic +12, transcendental -1": of the chip that differs most from the first measure.
std::string reason_of(const Comparison& comparison, const std::vector<Measure>& measures) {
    std::size_t furthest = 0;
    double most = 0;
    for (std::size_t i = 1; i < measures.size(); ++i) {
        if (comparison.ratios[i].empty()) continue;
        const double change = std::abs(std::log(middle(comparison.ratios[i]) / middle(comparison.ratios[0])));
        if (change > most) {
            most = change;
            furthest = i;
        }
    }
    std::vector<std::string> changes;
    for (const auto& [which, counts] : comparison.instructions)
        if (const double change = middle(counts); which.first == furthest && std::abs(change) >= 0.5)
            changes.push_back(fmt::format("{} {:+.0f}", which.second, change));
    if (furthest == 0 || changes.empty()) return "";
    return fmt::format("{}: {}", measures[furthest].name(), join(changes, ", "));
}

Measure measure_of(const ChipRow& chip) {
    return {chip.gpu, chip.driver};
}

std::string title_of(const Measure& measure) {
    return measure.gpu.empty() ? "llvmpipe: weighted operations"
                               : fmt::format("{}: cycles ({})", measure.gpu, measure.driver);
}

/// Markdown's table as HTML, which needs no more of it than bold and code.
std::string html_of(const std::string& markdown) {
    std::vector<HtmlRow> rows;
    std::vector<std::string> header;
    std::size_t line_number = 0;
    for (const std::string& line : split(markdown, '\n')) {
        std::vector<std::string> cells;
        for (std::size_t at = 1; at < line.size();) {
            const std::size_t end = std::min(line.find('|', at), line.size());
            std::string cell(trim(std::string_view(line).substr(at, end - at)));
            std::erase(cell, '`');
            cells.push_back(std::move(cell));
            at = end + 1;
        }
        if (line_number == 0)
            header = std::move(cells);
        else if (line_number > 1)
            rows.push_back({std::move(cells)});
        ++line_number;
    }
    return html_table(header, rows);
}

/// Every quality on some front, with its number in the charts.
std::string numbers_table(const Group& rows, const std::vector<Measure>& measures) {
    std::vector<std::string> header = {"", "quality", "error, max"};
    for (const Measure& measure : measures) header.push_back(measure.name());
    std::vector<HtmlRow> lines;
    const StudyRow* accurate = most_accurate_of(rows);
    for (const StudyRow* row : on_any_front(rows, measures)) {
        std::vector<std::string> cells = {std::to_string(lines.size() + 1),
                                          row->quality.empty() ? "most accurate" : row->quality,
                                          short_number(row->total.max)};
        bool on_all = true;
        for (const Measure& measure : measures) {
            const auto cost = measure.cost(*row);
            const auto whole = accurate == nullptr ? std::nullopt : measure.cost(*accurate);
            on_all = on_all && measure.on_front(*row);
            cells.push_back(cost && whole ? fmt::format("\u00d7{:.3f}{}", *cost / *whole,
                                                        measure.on_front(*row) ? " on the front" : "")
                                          : "\u2013");
        }
        lines.push_back({std::move(cells), on_all ? "" : "changes"});
    }
    return html_table(header, lines);
}

}  // namespace

const ChipRow* Measure::chip(const StudyRow& row) const {
    const auto found = std::find_if(row.chips.begin(), row.chips.end(),
                                    [&](const ChipRow& chip) { return chip.gpu == gpu; });
    return gpu.empty() || found == row.chips.end() ? nullptr : &*found;
}

std::optional<double> Measure::cost(const StudyRow& row) const {
    if (gpu.empty()) return row.costs.total;
    const ChipRow* figures = chip(row);
    return figures == nullptr ? std::nullopt : figures->cycles;
}

bool Measure::on_front(const StudyRow& row) const {
    if (gpu.empty()) return row.on_front;
    const ChipRow* figures = chip(row);
    return figures != nullptr && figures->on_front && figures->cycles;
}

Result<std::vector<Measure>> measures_of(const std::vector<StudyRow>& rows,
                                         const std::vector<std::string>& gpus) {
    std::vector<Measure> measures = {{}};
    std::vector<std::string> known;
    if (!rows.empty())
        for (const ChipRow& chip : rows.front().chips) known.push_back(chip.gpu);
    for (const std::string& gpu : gpus.empty() ? known : gpus) {
        const auto found = std::find(known.begin(), known.end(), gpu);
        if (found == known.end())
            return fail(Fault::input, fmt::format("the study holds no cycles of {}", gpu),
                        fmt::format("add them: gobo cost FAMILY --study FILE --gpu {} > NEW", gpu));
        measures.push_back(measure_of(rows.front().chips[static_cast<std::size_t>(found - known.begin())]));
    }
    return measures;
}

std::string fronts_table(const std::vector<StudyRow>& rows, const std::vector<Measure>& measures) {
    Group all;
    for (const StudyRow& row : rows) all.push_back(&row);
    std::set<const StudyRow*> chosen;
    for (const Measure& measure : measures) {
        const StudyRow* last = nullptr;
        const auto decade = [](const StudyRow& row) { return std::ceil(std::log10(row.total.max)); };
        for (const StudyRow* row : front_by(all, measure)) {
            if (last == nullptr) chosen.insert(row);
            // Less accurate on the front is cheaper: the last within a power of ten is the cheapest.
            if (last != nullptr && decade(*last) != decade(*row)) chosen.insert(last);
            last = row;
        }
        if (last != nullptr) chosen.insert(last);
    }
    std::vector<std::string> header = {"quality", "largest error"};
    for (const Measure& measure : measures)
        header.push_back(measure.name() + (measure.gpu.empty() ? ", additions" : ", cycles"));
    std::string text = markdown_header(header);
    for (const StudyRow* row : on_any_front(all, measures)) {
        if (!chosen.contains(row)) continue;
        std::vector<std::string> cells = {row->quality.empty() ? "most accurate" : "`" + row->quality + "`",
                                          short_number(row->total.max)};
        for (const Measure& measure : measures) {
            const auto cost = measure.cost(*row);
            const std::string number = cost ? short_number(*cost) : "\u2013";
            cells.push_back(measure.on_front(*row) ? "**" + number + "**" : number);
        }
        text += markdown_row(cells);
    }
    return text;
}

std::string fronts_svg(const Family& family, const std::vector<std::string>& rate,
                       const std::vector<const StudyRow*>& rows, const std::string& title,
                       const std::vector<Measure>& measures) {
    constexpr int kWidth = 720;
    constexpr int kHeight = 225;
    constexpr int kTitle = 30;
    const StudyRow* accurate = most_accurate_of(rows);
    std::vector<double> errors;
    std::vector<double> costs;
    const auto relative = [&](const StudyRow& row, const Measure& measure) -> std::optional<double> {
        const auto cost = measure.cost(row);
        const auto whole = accurate == nullptr ? std::nullopt : measure.cost(*accurate);
        if (!cost || !whole || *whole <= 0) return std::nullopt;
        return *cost / *whole;
    };
    for (const StudyRow* row : rows) {
        errors.push_back(row->total.max);
        for (const Measure& measure : measures)
            if (const auto cost = relative(*row, measure)) costs.push_back(*cost);
    }
    std::map<const StudyRow*, std::size_t> numbers;
    for (const StudyRow* row : on_any_front(rows, measures)) numbers.emplace(row, numbers.size() + 1);
    const int coloured = coloured_feature(family, rate);
    std::string charts;
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const Measure& measure = measures[i];
        Chart chart(title_of(measure),
                    axis_for(i + 1 < measures.size() ? "" : "cost relative to the most accurate quality",
                             costs, 0.01),
                    axis_for("largest error", errors, kLeastError), kWidth, kHeight);
        std::vector<bool> used(kSeries);
        const auto add = [&](const StudyRow& row) {
            const auto cost = relative(row, measure);
            if (!cost) return;
            const int series =
                coloured < 0
                    ? 0
                    : parse_key(family, row.key).value()[static_cast<std::size_t>(coloured)] % kSeries;
            used[static_cast<std::size_t>(series)] = true;
            const bool on_front = measure.on_front(row);
            chart.add({*cost, std::max(row.total.max, kLeastError), series, !on_front, on_front ? 6.0 : 4.0,
                       "",
                       fmt::format("{}\nerror: {}\ncost: {}", row.key, short_number(row.total.max),
                                   short_number(*measure.cost(row))),
                       on_front ? std::to_string(numbers.at(&row)) : ""});
        };
        for (const StudyRow* row : rows)
            if (!measure.on_front(*row)) add(*row);
        std::vector<std::pair<double, double>> corners;
        for (const StudyRow* row : front_by(rows, measure)) {
            add(*row);
            if (const auto cost = relative(*row, measure))
                corners.emplace_back(*cost, std::max(row->total.max, kLeastError));
        }
        std::reverse(corners.begin(), corners.end());
        chart.add_steps(corners);
        if (i + 1 == measures.size()) {
            for (std::size_t value = 0; coloured >= 0 && value < used.size(); ++value) {
                const Feature& feature = family.features[static_cast<std::size_t>(coloured)];
                if (used[value] && value < feature.values.size())
                    chart.add_legend(fmt::format("{}={}", feature.name, feature.values[value]),
                                     static_cast<int>(value));
            }
            chart.add_legend("front: nothing is better in both", -1);
            chart.add_legend("hollow: not on this front", 0, true);
        }
        charts += chart.svg(kTitle + static_cast<int>(i) * kHeight);
    }
    const int height = kTitle + static_cast<int>(measures.size()) * kHeight + 60;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"sans-serif\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
        "<text x=\"12\" y=\"20\" font-size=\"14\" font-weight=\"bold\">{2}</text>\n{3}</svg>\n",
        kWidth, height, html_escaped(title), charts);
}

std::string changed_places_table(const Family& family, const std::vector<StudyRow>& rows,
                                 const std::vector<Measure>& measures) {
    std::vector<std::string> header = {"feature", "value", "against"};
    for (const Measure& measure : measures) header.push_back(measure.name());
    header.insert(header.end(), {"instructions more", "pairs"});
    std::string text = markdown_header(header);
    for (const int index : quality_features(family)) {
        const Feature& feature = family.features[static_cast<std::size_t>(index)];
        for (const auto& [values, comparison] :
             comparisons_of(family, rows, measures, static_cast<std::size_t>(index))) {
            const int order = order_of(comparison.ratios[0]);
            // Each pair once, and that which is cheaper by additions first.
            const bool is_told = order < 0 || (order == 0 && values.first > values.second);
            const bool changes = std::any_of(
                comparison.ratios.begin() + 1, comparison.ratios.end(),
                [&](const auto& ratios) { return order_of(ratios) != order && order_of(ratios) != 0; });
            if (!is_told || !changes) continue;
            std::vector<std::string> cells = {
                feature.name, "`" + feature.values[static_cast<std::size_t>(values.first)] + "`",
                "`" + feature.values[static_cast<std::size_t>(values.second)] + "`"};
            for (const auto& ratios : comparison.ratios) cells.push_back(ratio_cell(ratios));
            cells.push_back(reason_of(comparison, measures));
            cells.push_back(std::to_string(comparison.pairs));
            text += markdown_row(cells);
        }
    }
    return text;
}

std::string values_table(const Family& family, const std::vector<StudyRow>& rows,
                         const std::vector<Measure>& measures) {
    std::vector<std::string> header = {"feature", "value", "matters in"};
    for (const Measure& measure : measures) header.push_back(measure.name());
    std::string text = markdown_header(header);
    const std::vector<Group> groups = groups_of(rows);
    for (const int index : quality_features(family)) {
        const Feature& feature = family.features[static_cast<std::size_t>(index)];
        struct Count {
            std::size_t matters = 0;
            std::vector<std::size_t> fronts;
        };
        std::map<int, Count> counts;
        for (const Group& group : groups) {
            std::map<int, std::vector<bool>> seen;  // by value and measure
            for (const StudyRow* row : group) {
                const int value = parse_key(family, row->key).value()[static_cast<std::size_t>(index)];
                std::vector<bool>& on_fronts = seen[value];
                on_fronts.resize(measures.size());
                for (std::size_t i = 0; i < measures.size(); ++i)
                    if (measures[i].on_front(*row)) on_fronts[i] = true;
            }
            if (seen.size() < 2) continue;  // it is the same in all
            for (const auto& [value, on_fronts] : seen) {
                Count& count = counts[value];
                ++count.matters;
                count.fronts.resize(measures.size());
                for (std::size_t i = 0; i < measures.size(); ++i) count.fronts[i] += on_fronts[i] ? 1 : 0;
            }
        }
        for (const auto& [value, count] : counts) {
            std::vector<std::string> cells = {feature.name,
                                              "`" + feature.values[static_cast<std::size_t>(value)] + "`",
                                              std::to_string(count.matters)};
            for (const std::size_t fronts : count.fronts) cells.push_back(std::to_string(fronts));
            text += markdown_row(cells);
        }
    }
    return text;
}

std::string fronts_page(const Family& family, const std::vector<std::string>& rate,
                        const std::vector<StudyRow>& rows, const std::vector<Measure>& measures) {
    std::string page = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>Fronts on GPUs: {0}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n"
        "body {{ font: 15px/1.5 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; }}\n"
        "table {{ border-collapse: collapse; font-size: 13px; }}\n"
        "td, th {{ border-bottom: 1px solid #ddd; padding: 2px 8px; text-align: left; }}\n"
        ".changes {{ background: #fff4d6; }}\nsvg {{ max-width: 100%; height: auto; }}\n</style>\n</head>\n"
        "<body>\n<h1>Fronts on GPUs: {0}</h1>\n"
        "<p>Error against cost of every quality, by llvmpipe's weighted operations and by what the compilers "
        "of "
        "GPUs estimate. Those cycles are static estimates for 64 fragments with their part of the vertices: "
        "nothing was timed, and lookups of textures are hardly charged. Qualities with loops whose turns a "
        "compiler guesses are left out.</p>\n<ul>\n",
        html_escaped(family.name));
    for (const Measure& measure : measures)
        page += fmt::format("<li>{}</li>\n", html_escaped(title_of(measure)));
    page +=
        "</ul>\n<h2>Choices that change places</h2>\n"
        "<p>The first value is cheaper than the second by weighted operations and not by every chip: the "
        "middle "
        "ratio of their costs, over all qualities measured that differ in nothing else, and the instructions "
        "that "
        "the first takes more of on the chip that differs most.</p>\n" +
        html_of(changed_places_table(family, rows, measures)) +
        "<h2>Values on the fronts</h2>\n<p>On how many fronts a value is, of as many combinations of effects "
        "and "
        "scenes as it matters in.</p>\n" +
        html_of(values_table(family, rows, measures));
    for (const Group& group : whole_groups(rows)) {
        const std::string& effects = group.front()->effects;
        page +=
            fmt::format("<h2>{}</h2>\n{}{}", html_escaped(effects),
                        fronts_svg(family, rate, group, effects, measures), numbers_table(group, measures));
    }
    return page + "</body>\n</html>\n";
}

}  // namespace gobo::study
