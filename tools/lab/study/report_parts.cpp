#include "lab/study/report_parts.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "lab/render/image_file.hpp"
#include "core/csv.hpp"
#include "lab/study/front_table.hpp"

namespace gobo::study {
namespace {

bool is_number(const std::string& cell) {
    return !cell.empty() && (std::isdigit(static_cast<unsigned char>(cell[0])) != 0 || cell[0] == '-' ||
                             cell[0] == '+' || cell.starts_with("\u00d7"));
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63U];
    }
    return text;
}

std::string ratio_text(double ratio) {
    return "\u00d7 " + fmt::format("{:.2f}", ratio);
}

using GuardColumns = std::map<std::string, std::size_t>;

/// Where the columns of the guards' prices stand; nothing where one is missing.
std::optional<GuardColumns> guard_columns(const CsvTable& table) {
    GuardColumns columns;
    for (const char* name :
         {"guard", "key", "operations_guarded", "operations_plain", "guarded_us_low", "guarded_us",
          "guarded_us_high", "plain_us_low", "plain_us", "plain_us_high", "renderer"}) {
        const auto index = table.column(name);
        if (!index) return std::nullopt;
        columns[name] = *index;
    }
    return columns;
}

std::vector<std::string> guard_row(const std::vector<std::string>& row, const GuardColumns& columns) {
    const auto cell = [&](const std::string& name) { return row[columns.at(name)]; };
    const auto spread = [&](const std::string& name) {
        const auto end = [&](const char* part) { return std::strtod(cell(name + part).c_str(), nullptr); };
        return Spread{end(""), end("_low"), end("_high")};
    };
    const Spread guarded = spread("guarded_us");
    const Spread plain = spread("plain_us");
    const std::string verdict =
        guarded.overlaps(plain) ? "\u2014" : ratio_text(guarded.median / plain.median);
    return {cell("guard"),
            cell("key"),
            fmt::format("{} ({})", cell("operations_guarded"), cell("operations_plain")),
            spread_text(guarded),
            spread_text(plain),
            verdict};
}

}  // namespace

std::string option(const std::string& value, const std::string& label) {
    return fmt::format("<option value=\"{}\">{}</option>", escaped(value), escaped(label));
}

std::string html_table(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::string>& classes) {
    std::string text = "<table>\n<tr>";
    for (const std::string& cell : header) text += "<th>" + escaped(cell) + "</th>";
    text += "</tr>\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool has_class = i < classes.size() && !classes[i].empty();
        text += has_class ? fmt::format("<tr class=\"{}\">", classes[i]) : "<tr>";
        for (const std::string& cell : rows[i])
            text += fmt::format("<td{}>{}</td>", is_number(cell) ? " class=\"number\"" : "", escaped(cell));
        text += "</tr>\n";
    }
    return text + "</table>\n";
}

std::map<std::string, Chart> curve_charts(const ReportInput& input) {
    std::map<std::string, std::vector<const CurvePoint*>> curves;
    for (const CurvePoint& point : input.study.curves)
        curves[fmt::format("curve.{}.{}.svg", point.feature, point.over)].push_back(&point);
    std::map<std::string, Chart> charts;
    for (const auto& [name, points] : curves) {
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
        Chart chart(fmt::format("{}: {}", first.feature, first.effects), axis_for(along, true, numbers, 1e-3),
                    axis_for("RMS error, linear radiance", true, errors, 1e-8));
        for (std::size_t series = 0; series < values.size(); ++series) {
            std::vector<std::pair<double, double>> line;
            for (const CurvePoint* point : points) {
                if (point->value != values[series]) continue;
                const double error = std::max(point->total.rms, 1e-8);
                line.emplace_back(point->number, error);
                chart.add({point->number, error, static_cast<int>(series), false, 4, "",
                           fmt::format("{}={} at {}: RMS {}, max {}", first.feature, values[series],
                                       short_number(point->number), short_number(point->total.rms),
                                       short_number(point->total.max))});
            }
            chart.add_line(line, static_cast<int>(series));
            chart.add_legend(values[series], static_cast<int>(series));
        }
        charts.emplace(name, std::move(chart));
    }
    return charts;
}

Chart time_chart(const CostAndTime& points, bool of_vertices, bool by_processor) {
    const std::string what = of_vertices ? "vertex" : "fragment";
    Chart chart(fmt::format("Cost against time of a {}", what),
                axis_for(fmt::format("weighted cost of a {}, in additions", what), true, points.cost, 1),
                axis_for(fmt::format("{} time of a {}, ns", by_processor ? "processor" : "elapsed", what),
                         true, points.nanoseconds, 0.1),
                560, 360);
    for (std::size_t i = 0; i < points.cost.size(); ++i)
        chart.add({points.cost[i], points.nanoseconds[i], 0, true, 4, "",
                   fmt::format("{} additions, {} ns", short_number(points.cost[i]),
                               short_number(points.nanoseconds[i]))});
    return chart;
}

std::string choices_table(const ReportInput& input) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> classes;
    for (const ChoiceSummary& choice : summarise_choices(input.family, input.study, input.weights)) {
        if (choice.combinations == 0) continue;
        std::string verdict = choice.is_retired ? "retired; " : "";
        if (!choice.dominated_by.empty())
            verdict +=
                fmt::format("dominated everywhere by {} ({} comparisons)", choice.dominated_by, choice.pairs);
        else if (choice.is_most_accurate)
            verdict += "most accurate";
        const std::string cost =
            choice.least_cost == choice.most_cost
                ? ratio_text(choice.least_cost)
                : ratio_text(choice.least_cost) + " to " + fmt::format("{:.2f}", choice.most_cost);
        rows.push_back({choice.feature, choice.value, short_number(choice.error_max),
                        short_number(choice.error_rms), cost, verdict});
        classes.push_back(choice.dominated_by.empty() ? "" : "dominated");
    }
    return html_table({"feature", "value", "error, max", "RMS", "cost", ""}, rows, classes);
}

std::string changes_section(const ReportInput& input) {
    if (input.study.changes.empty()) return "";
    std::vector<std::vector<std::string>> rows;
    for (const ChangeResult& result : input.study.changes)
        rows.push_back({result.change.from, result.change.to, short_number(result.difference.max),
                        short_number(result.difference.rms), short_number(result.largest)});
    return "<h2 id=\"changes\">Changes of model</h2>\n<p>Both exact: no error of either, but another look. "
           "The "
           "exponents are matched as the plan says.</p>\n" +
           html_table({"from", "to", "difference, max", "RMS", "brightest"}, rows);
}

std::string guards_section(const ReportInput& input) {
    if (input.guard_prices.empty()) return "";
    const CsvTable table = read_csv(input.guard_prices);
    std::string text = "<h2 id=\"guards\">What guards cost</h2>\n";
    const std::optional<GuardColumns> columns = guard_columns(table);
    if (!columns || table.rows.empty())
        return text + "<div class=\"wide\">" + html_table(table.columns, table.rows) + "</div>\n";
    text += fmt::format(
        "<p>What keeps hard inputs from undefined operations, with each guard and without it: operations of "
        "an "
        "invocation, and microseconds of a draw (median, middle half) on {}. A dash: no measurable "
        "difference. Rows of docs/data/guard_prices.csv.</p>\n",
        escaped(table.rows.front()[columns->at("renderer")]));
    std::vector<std::vector<std::string>> rows;
    for (const std::vector<std::string>& row : table.rows) rows.push_back(guard_row(row, *columns));
    return text +
           html_table({"guard", "in", "operations (without)", "time, \u00b5s", "without", "ratio"}, rows);
}

Result<std::string> map_figures(const ReportInput& input) {
    std::string text;
    for (const HeatMap& map : input.maps) {
        const Result<std::string> png = encode_image(map.image, ImageFormat::png);
        if (!png) return tl::unexpected(png.error());
        const std::string caption =
            map.quality.empty() ? "the scene: " + input.study.plan.quick.back()
                                : fmt::format("{}: at most {}", map.quality, short_number(map.largest));
        text += fmt::format(
            "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}"
            "</figcaption></figure>\n",
            escaped(caption), base64(*png));
    }
    return text;
}

std::string heat_scale() {
    std::string stops;
    for (int i = 0; i <= 12; ++i) {
        const std::array<double, 3> color = heat_color(kCoolest * std::pow(kHottest / kCoolest, i / 12.0));
        stops += fmt::format("{}rgb({:.0f} {:.0f} {:.0f})", i > 0 ? "," : "", 255 * srgb_of_linear(color[0]),
                             255 * srgb_of_linear(color[1]), 255 * srgb_of_linear(color[2]));
    }
    return fmt::format(
        "{} <span class=\"scale\" style=\"background:linear-gradient(to right,{})\"></span> {}",
        short_number(kCoolest), stops, short_number(kHottest));
}

}  // namespace gobo::study
