#include "lab/study/front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "budget/qualities.hpp"
#include "core/html.hpp"
#include "family/key.hpp"

namespace gobo::study {
namespace {

/// At most so many lines are enough to see what a budget buys.
constexpr std::size_t kFrontLines = 6;

/// Errors below are drawn as this: what is exact has no place on a logarithmic axis.
constexpr double kLeastShown = 1e-8;

/// The order of the front: what is more accurate on it is dearer.
bool is_more_accurate(const StudyRow* a, const StudyRow* b) {
    return std::tuple(b->costs.total, a->key) < std::tuple(a->costs.total, b->key);
}

/// The most accurate row, then for each power of ten of the error the cheapest row within it.
std::vector<const StudyRow*> cheapest_by_decade(const std::vector<const StudyRow*>& front) {
    std::vector<const StudyRow*> chosen = {front.front()};
    for (const StudyRow* row : front) {
        if (row == front.front()) continue;
        const auto decade = [](const StudyRow& one) { return std::ceil(std::log10(one.total.max)); };
        if (chosen.size() > 1 && decade(*chosen.back()) == decade(*row))
            chosen.back() = row;  // less accurate on the front is cheaper
        else
            chosen.push_back(row);
    }
    return chosen;
}

/// How far the row's cost is from that of the nearest row chosen, as a ratio of 1 or more.
double distance(const StudyRow& row, const std::vector<const StudyRow*>& chosen) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const StudyRow* other : chosen)
        nearest = std::min(
            nearest, std::max(row.costs.total / other->costs.total, other->costs.total / row.costs.total));
    return nearest;
}

/// Up to kFrontLines lines, where the front has so many: whichever row's cost is furthest from those chosen.
void fill_up(const std::vector<const StudyRow*>& front, std::vector<const StudyRow*>& chosen) {
    while (chosen.size() < std::min(kFrontLines, front.size()))
        chosen.push_back(*std::max_element(front.begin(), front.end(), [&](const auto* a, const auto* b) {
            return distance(*a, chosen) < distance(*b, chosen);
        }));
    std::sort(chosen.begin(), chosen.end(), is_more_accurate);
}

/// The feature that colours the points: the first that says where light is computed, else the first quality.
int coloured_feature(const Family& family, const std::vector<std::string>& rate) {
    for (const std::string& name : rate)
        if (const auto feature = family.index_of(name)) return *feature;
    const std::vector<int> features = quality_features(family);
    return features.empty() ? -1 : features.front();
}

std::string tip_of(const StudyRow& row) {
    std::string tip = fmt::format(
        "{}\nerror: max {}, 99.9 % {}, RMS {}\nof it rounding {}, approximation {}, shading rate {}\n"
        "cost: {} additions a fragment, {} a vertex",
        row.key, short_number(row.total.max), short_number(row.total.p999), short_number(row.total.rms),
        short_number(row.rounding.max), short_number(row.approximation.max), short_number(row.rate.max),
        short_number(row.costs.fragment), short_number(row.costs.vertex));
    if (row.timing)
        tip +=
            fmt::format("\ntime: {} ns a fragment with its share of the vertices{}", spread_text(row.time()),
                        row.on_time_front.value_or(false) ? ", on the front by time" : "");
    if (row.instructions)
        tip += fmt::format("\ninstructions: {} a fragment", short_number(*row.instructions));
    if (!row.dominated_by.empty()) tip += "\ndominated by " + row.dominated_by;
    return tip;
}

}  // namespace

std::string spread_text(const Spread& spread) {
    return fmt::format("{} ({} to {})", short_number(spread.median), short_number(spread.low),
                       short_number(spread.high));
}

std::vector<const StudyRow*> front_of(const std::vector<const StudyRow*>& rows) {
    std::vector<const StudyRow*> front;
    for (const StudyRow* row : rows)
        if (row->on_front) front.push_back(row);
    std::sort(front.begin(), front.end(), is_more_accurate);
    return front;
}

std::string front_table(const std::vector<StudyRow>& rows) {
    std::vector<const StudyRow*> all;
    for (const StudyRow& row : rows) all.push_back(&row);
    const std::vector<const StudyRow*> front = front_of(all);
    std::vector<const StudyRow*> lines = front;
    if (!lines.empty()) lines = cheapest_by_decade(lines);
    if (lines.size() > kFrontLines) lines.erase(lines.begin() + 1, lines.end() - (kFrontLines - 1));
    fill_up(front, lines);
    std::string text =
        "| quality | largest error | RMS error | cost, additions | time, ns |\n|---|---|---|---|---|\n";
    for (const StudyRow* row : lines)
        text += fmt::format("| {} | {} | {} | {} | {} |\n",
                            row->quality.empty() ? "most accurate" : "`" + row->quality + "`",
                            short_number(row->total.max), short_number(row->total.rms),
                            short_number(row->costs.total), row->timing ? spread_text(row->time()) : "");
    return text;
}

Chart front_chart(const Family& family, const std::vector<std::string>& rate,
                  const std::vector<const StudyRow*>& rows, std::string title) {
    std::vector<double> costs;
    std::vector<double> errors;
    for (const StudyRow* row : rows) {
        costs.push_back(row->costs.total);
        errors.push_back(row->total.max);
    }
    Chart chart(std::move(title), axis_for("weighted cost of a fragment, in additions", costs, 1),
                axis_for("largest error, linear radiance", errors, kLeastShown));
    const int coloured = coloured_feature(family, rate);
    std::vector<bool> used(kSeries);
    const auto add = [&](const StudyRow& row, const std::string& label) {
        const Key key = parse_key(family, row.key).value();
        const int series = coloured < 0 ? 0 : key[static_cast<std::size_t>(coloured)];
        used[static_cast<std::size_t>(series) % used.size()] = true;
        std::vector<int> values;  // of the quality features, by number, for the page's filter
        for (const int feature : quality_features(family))
            values.push_back(key[static_cast<std::size_t>(feature)]);
        chart.add({row.costs.total, std::max(row.total.max, kLeastShown), series, !row.on_front,
                   row.on_front ? 6.0 : 4.0,
                   fmt::format(R"(class="point" tabindex="0" data-key="{}" data-values="{}")",
                               html_escaped(row.key), fmt::join(values, " ")),
                   tip_of(row), label});
    };
    // Dominated ones first, so that the front lies on top.
    for (const StudyRow* row : rows)
        if (!row->on_front) add(*row, "");
    const std::vector<const StudyRow*> front = front_of(rows);
    std::vector<std::pair<double, double>> corners;
    for (std::size_t i = 0; i < front.size(); ++i) {
        add(*front[i], std::to_string(i + 1));
        corners.emplace_back(front[i]->costs.total, std::max(front[i]->total.max, kLeastShown));
    }
    std::reverse(corners.begin(), corners.end());
    chart.add_steps(corners);
    for (std::size_t value = 0; coloured >= 0 && value < used.size(); ++value) {
        const Feature& feature = family.features[static_cast<std::size_t>(coloured)];
        if (used[value])
            chart.add_legend(fmt::format("{}={}", feature.name, feature.values[value]),
                             static_cast<int>(value));
    }
    chart.add_legend("front: nothing is better in both", -1);
    chart.add_legend("hollow: dominated", 0, true);
    return chart;
}

}  // namespace gobo::study
