#include "study/front_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "family/key.hpp"
#include "study/qualities.hpp"
#include "study/time_study.hpp"

namespace gobo::study {
namespace {

/// Errors below are drawn as this: what is exact has no place on a logarithmic axis.
constexpr double kLeastShown = 1e-8;

double number_in(const std::string& cell) {
    double number = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    return error == std::errc() && end == cell.data() + cell.size()
               ? number
               : std::numeric_limits<double>::quiet_NaN();
}

Diagnostic problem(const std::string& path, std::size_t row, std::string message) {
    Diagnostic diagnostic;
    diagnostic.place = {path, static_cast<int>(row) + 2, 0};
    diagnostic.message = std::move(message);
    diagnostic.remedy =
        "name effects that the study holds, or make a study of them: gobo study FAMILY "
        "--effects KEY -o FOLDER";
    return diagnostic;
}

/// The cells of a row by the names of their columns.
class Cells {
  public:
    Cells(const CsvTable& table, std::size_t row) : table_(table), row_(table.rows[row]) {}
    [[nodiscard]] std::string text(std::string_view column) const {
        const auto index = table_.column(column);
        return index ? row_[*index] : "";
    }
    [[nodiscard]] double number(std::string_view column) const { return number_in(text(column)); }

  private:
    const CsvTable& table_;
    const std::vector<std::string>& row_;
};

Spread spread_in(const Cells& cells, const std::string& column) {
    return {cells.number(column), cells.number(column + "_q1"), cells.number(column + "_q3")};
}

std::optional<Timing> timing_in(const Cells& cells) {
    if (cells.text("rounds").empty()) return std::nullopt;
    Timing timing;
    for (const auto& [slopes, clock] :
         {std::pair{&timing.elapsed, "elapsed"}, std::pair{&timing.processor, "processor"}}) {
        slopes->fragment = spread_in(cells, fmt::format("fragment_ns_{}", clock));
        slopes->vertex = spread_in(cells, fmt::format("vertex_ns_{}", clock));
    }
    timing.rounds = static_cast<int>(cells.number("rounds"));
    timing.renderer = cells.text("renderer");
    return timing;
}

StudyRow row_in(const Family& family, const Cells& cells, const Key& key) {
    StudyRow row;
    row.effects = cells.text("effects");
    row.key = cells.text("key");
    row.quality = quality_text(family, key);
    row.scene = cells.text("scene");
    row.error = {cells.number("error_max"), cells.number("error_p999"), cells.number("error_rms")};
    row.rounding.max = cells.number("rounding_max");
    row.approximation.max = cells.number("approximation_max");
    row.rate.max = cells.number("rate_max");
    row.costs.fragment = cells.number("fragment_cost");
    row.costs.vertex = cells.number("vertex_cost");
    row.costs.vertices_per_fragment = cells.number("vertices_per_fragment");
    row.costs.total = cells.number("cost");
    row.on_front = cells.text("front") == "yes";
    row.dominated_by = cells.text("dominated_by");
    row.timing = timing_in(cells);
    if (row.timing && !cells.text("time_front").empty())
        row.on_time_front = cells.text("time_front") == "yes";
    return row;
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
        row.key, short_number(row.error.max), short_number(row.error.p999), short_number(row.error.rms),
        short_number(row.rounding.max), short_number(row.approximation.max), short_number(row.rate.max),
        short_number(row.costs.fragment), short_number(row.costs.vertex));
    if (row.timing)
        tip += fmt::format("\ntime: {} ns a fragment with its share of the vertices{}",
                           spread_text(time_of(row)),
                           row.on_time_front.value_or(false) ? ", on the front by time" : "");
    if (row.instructions)
        tip += fmt::format("\ninstructions: {} a fragment", short_number(*row.instructions));
    if (!row.dominated_by.empty()) tip += "\ndominated by " + row.dominated_by;
    return tip;
}

/// The values of the quality features, by number, for the page's filter.
std::string value_numbers(const Family& family, const Key& key) {
    std::vector<int> numbers;
    for (const int feature : quality_features(family))
        numbers.push_back(key[static_cast<std::size_t>(feature)]);
    return fmt::format("{}", fmt::join(numbers, " "));
}

/// The most accurate row, then for each power of ten of the error the cheapest row within it.
std::vector<const StudyRow*> cheapest_by_decade(const std::vector<const StudyRow*>& front) {
    std::vector<const StudyRow*> chosen = {front.front()};
    for (const StudyRow* row : front) {
        if (row == front.front()) continue;
        const auto decade = [](const StudyRow& one) { return std::ceil(std::log10(one.error.max)); };
        if (chosen.size() > 1 && decade(*chosen.back()) == decade(*row))
            chosen.back() = row;  // less accurate on the front is cheaper
        else
            chosen.push_back(row);
    }
    return chosen;
}

}  // namespace

Result<std::vector<StudyRow>> read_rows(std::string_view csv, const std::string& path, const Family& family,
                                        const Key& effects) {
    const CsvTable table = read_csv(csv);
    for (const char* column : {"effects", "key", "scene", "error_max", "cost", "front"})
        if (!table.column(column)) return fail(problem(path, 0, fmt::format("has no column '{}'", column)));
    std::vector<StudyRow> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const Cells cells(table, i);
        if (cells.text("scene") != kAllScenes) continue;
        const auto own = parse_key(family, cells.text("effects"));
        const auto key = parse_key(family, cells.text("key"));
        if (!own || !key) return fail(problem(path, i, (own ? key.error() : own.error()).front().message));
        if (*own == effects) rows.push_back(row_in(family, cells, *key));
    }
    if (!rows.empty()) return rows;
    return fail(problem(path, 0, fmt::format("holds no '{}'", key_text(family, effects))));
}

std::string spread_text(const Spread& spread) {
    return fmt::format("{} ({} to {})", short_number(spread.median), short_number(spread.low),
                       short_number(spread.high));
}

std::vector<const StudyRow*> front_of(const std::vector<const StudyRow*>& rows) {
    std::vector<const StudyRow*> front;
    for (const StudyRow* row : rows)
        if (row->on_front) front.push_back(row);
    std::sort(front.begin(), front.end(), [](const StudyRow* a, const StudyRow* b) {
        return std::tuple(b->costs.total, a->key) < std::tuple(a->costs.total, b->key);
    });
    return front;
}

std::string front_table(const std::vector<StudyRow>& rows) {
    std::vector<const StudyRow*> all;
    for (const StudyRow& row : rows) all.push_back(&row);
    std::vector<const StudyRow*> lines = front_of(all);
    if (!lines.empty()) lines = cheapest_by_decade(lines);
    if (lines.size() > kFrontLines) lines.erase(lines.begin() + 1, lines.end() - (kFrontLines - 1));
    std::string text =
        "| quality | largest error | RMS error | cost, additions | time, ns |\n|---|---|---|---|---|\n";
    for (const StudyRow* row : lines)
        text += fmt::format("| {} | {} | {} | {} | {} |\n",
                            row->quality.empty() ? "most accurate" : "`" + row->quality + "`",
                            short_number(row->error.max), short_number(row->error.rms),
                            short_number(row->costs.total), row->timing ? spread_text(time_of(*row)) : "");
    return text;
}

Chart front_chart(const Family& family, const std::vector<std::string>& rate,
                  const std::vector<const StudyRow*>& rows, std::string title) {
    std::vector<double> costs;
    std::vector<double> errors;
    for (const StudyRow* row : rows) {
        costs.push_back(row->costs.total);
        errors.push_back(row->error.max);
    }
    Chart chart(std::move(title), axis_for("weighted cost of a fragment, in additions", true, costs, 1),
                axis_for("largest error, linear radiance", true, errors, kLeastShown));
    const int feature = coloured_feature(family, rate);
    std::vector<bool> used(kSeries);
    const auto add = [&](const StudyRow& row, const std::string& label) {
        const Key key = parse_key(family, row.key).value();
        const int series = feature < 0 ? 0 : key[static_cast<std::size_t>(feature)];
        used[static_cast<std::size_t>(series) % used.size()] = true;
        chart.add({row.costs.total, std::max(row.error.max, kLeastShown), series, !row.on_front,
                   row.on_front ? 6.0 : 4.0,
                   fmt::format(R"(class="point" tabindex="0" data-key="{}" data-values="{}")",
                               escaped(row.key), value_numbers(family, key)),
                   tip_of(row), label});
    };
    // Dominated ones first, so that the front lies on top.
    for (const StudyRow* row : rows)
        if (!row->on_front) add(*row, "");
    const std::vector<const StudyRow*> front = front_of(rows);
    std::vector<std::pair<double, double>> corners;
    for (std::size_t i = 0; i < front.size(); ++i) {
        add(*front[i], std::to_string(i + 1));
        corners.emplace_back(front[i]->costs.total, std::max(front[i]->error.max, kLeastShown));
    }
    std::reverse(corners.begin(), corners.end());
    chart.add_steps(corners);
    for (std::size_t value = 0; feature >= 0 && value < used.size(); ++value) {
        const Feature& coloured = family.features[static_cast<std::size_t>(feature)];
        if (used[value])
            chart.add_legend(fmt::format("{}={}", coloured.name, coloured.values[value]),
                             static_cast<int>(value));
    }
    chart.add_legend("front: nothing is better in both", -1);
    chart.add_legend("hollow: dominated", 0, true);
    return chart;
}

}  // namespace gobo::study
