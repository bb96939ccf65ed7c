#include "lab/study/front.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/study/html.hpp"
#include "lab/study/qualities.hpp"

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

constexpr int kLeft = 84;
constexpr int kRight = 16;
constexpr int kTop = 34;
constexpr int kBottom = 54;
constexpr int kLegendRow = 18;

struct Look {
    const char* color;
    const char* dash;                                ///< of lines
    std::vector<std::pair<double, double>> outline;  ///< of marks; none: a circle
};

/// Blue circle, vermilion square, green triangle, orange diamond, purple triangle on its head, sky blue
/// pentagon, black star of four.
const Look& look_of(int series) {
    static const std::array<Look, kSeries> looks = {{
        {"#0072B2", "", {}},
        {"#D55E00", "7 3", {{-.9, -.9}, {.9, -.9}, {.9, .9}, {-.9, .9}}},
        {"#009E73", "2 3", {{0, -1.2}, {1.1, .8}, {-1.1, .8}}},
        {"#E69F00", "9 3 2 3", {{0, -1.3}, {1.3, 0}, {0, 1.3}, {-1.3, 0}}},
        {"#CC79A7", "5 5", {{0, 1.2}, {1.1, -.8}, {-1.1, -.8}}},
        {"#56B4E9", "1 4", {{0, -1.1}, {1.05, -.34}, {.65, .9}, {-.65, .9}, {-1.05, -.34}}},
        {"#000000",
         "12 4",
         {{0, -1.4}, {.4, -.4}, {1.4, 0}, {.4, .4}, {0, 1.4}, {-.4, .4}, {-1.4, 0}, {-.4, -.4}}},
    }};
    return looks[static_cast<std::size_t>(series) % kSeries];
}

std::string shape(int series, double x, double y, double size, bool is_hollow) {
    const Look& look = look_of(series);
    const std::string paint = fmt::format(R"(fill="{}" stroke="{}" stroke-width="1.5")",
                                          is_hollow ? "#ffffff" : look.color, look.color);
    if (look.outline.empty())
        return fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.1f}" {}/>)", x, y, size, paint);
    std::string points;
    for (const auto& [dx, dy] : look.outline)
        points += fmt::format("{:.1f},{:.1f} ", x + dx * size, y + dy * size);
    return fmt::format(R"(<polygon points="{}" {}/>)", points, paint);
}

/// Where an axis is labelled: at decades, and between them where these are few.
std::vector<double> ticks_of(const Axis& axis) {
    const double decades = std::log10(axis.high / axis.low);
    const int every = std::max(1, static_cast<int>(std::ceil(decades / 9)));
    const std::vector<double> factors = decades < 2.5 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
    const int first = static_cast<int>(std::floor(std::log10(axis.low) + 1e-9));
    std::vector<double> ticks;
    for (int decade = first; decade <= first + static_cast<int>(decades) + 1; decade += every)
        for (const double factor : factors) {
            const double at = factor * std::pow(10, decade);
            if (at >= axis.low * (1 - 1e-9) && at <= axis.high * (1 + 1e-9)) ticks.push_back(at);
        }
    return ticks;
}

/// Small and large powers of ten with their exponent raised, as readers write them.
std::string tick_label(double tick) {
    const double exponent = std::log10(std::abs(tick));
    const bool is_power = tick > 0 && std::abs(exponent - std::round(exponent)) < 1e-9;
    if (!is_power || (exponent > -2.5 && exponent < 3.5)) return short_number(tick);
    return fmt::format(R"(10<tspan dy="-5" font-size="9">{}{:.0f}</tspan>)", exponent < 0 ? "\u2212" : "",
                       std::abs(exponent));
}

/// The number of the form 1, 2 or 5 times a power of ten that is next to the value, below it or above it.
double round_end(double value, bool above) {
    const double decade = std::pow(10, std::floor(std::log10(value) + 1e-9));
    if (above) {
        for (const double factor : {1.0, 2.0, 5.0})
            if (factor * decade >= value * (1 - 1e-9)) return factor * decade;
        return 10 * decade;
    }
    for (const double factor : {5.0, 2.0})
        if (factor * decade <= value * (1 + 1e-9)) return factor * decade;
    return decade;
}

/// How far along the axis a value lies, 0 to 1.
double place(const Axis& axis, double value) {
    return std::log(std::max(value, axis.low) / axis.low) / std::log(axis.high / axis.low);
}

}  // namespace

int coloured_feature(const Family& family, const std::vector<std::string>& rate) {
    for (const std::string& name : rate)
        if (const auto feature = family.index_of(name)) return *feature;
    const std::vector<int> features = quality_features(family);
    return features.empty() ? -1 : features.front();
}

std::string spread_text(const Spread& spread) {
    return fmt::format("{} ({} to {})", short_number(spread.median), short_number(spread.low),
                       short_number(spread.high));
}

std::vector<const StudyRow*> front_of(const std::vector<const StudyRow*>& rows) {
    std::vector<const StudyRow*> front;
    for (const StudyRow* row : rows)
        if (row->on_front) front.push_back(row);
    std::sort(front.begin(), front.end(), is_more_accurate);
    if (front.empty()) return front;
    // Where errors are nothing but roundings, on scenes and over the domain, the cheapest stands for all.
    const double rounding = (1 + kChance) * front.front()->total.max;
    const auto is_alike = [&](const StudyRow* row, const StudyRow* other) {
        const bool worst_alike = row->worst.has_value() == other->worst.has_value() &&
                                 (!row->worst || *other->worst <= *row->worst + rounding);
        return other->total.max <= rounding && other->costs.total < row->costs.total && worst_alike;
    };
    const std::vector<const StudyRow*> all = front;
    std::erase_if(front, [&](const StudyRow* row) {
        return row->total.max <= rounding &&
               std::ranges::any_of(all, [&](const StudyRow* other) { return is_alike(row, other); });
    });
    return front;
}

namespace {

/// Of the domain, beyond rounding.
std::string worst_text(const StudyRow& row) {
    if (!row.worst) return "\u2013";
    return std::isfinite(*row.worst) ? short_number(*row.worst) : "not promised";
}

}  // namespace

std::string front_table(const std::vector<StudyRow>& rows) {
    std::vector<const StudyRow*> all;
    for (const StudyRow& row : rows) all.push_back(&row);
    const std::vector<const StudyRow*> front = front_of(all);
    std::vector<const StudyRow*> lines = front;
    if (!lines.empty()) lines = cheapest_by_decade(lines);
    if (lines.size() > kFrontLines) lines.erase(lines.begin() + 1, lines.end() - (kFrontLines - 1));
    fill_up(front, lines);
    std::string text =
        "| quality | largest error | RMS error | worst of the domain | cost, additions | time, ns |\n"
        "|---|---|---|---|---|---|\n";
    for (const StudyRow* row : lines)
        text += fmt::format("| {} | {} | {} | {} | {} | {} |\n",
                            row->quality.empty() ? "most accurate" : "`" + row->quality + "`",
                            short_number(row->total.max), short_number(row->total.rms), worst_text(*row),
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

Axis axis_for(std::string title, const std::vector<double>& values, double least) {
    double low = 1e300;
    double high = least;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, std::max(value, least));
        high = std::max(high, value);
    }
    if (low > high || high <= 0) return {std::move(title), 0.1, 1};
    // Some room beside the outermost marks.
    low = std::max(round_end(low * 0.8, false), std::min(low, least));
    return {std::move(title), low, std::max(round_end(high * 1.2, true), low * 5)};
}

Chart::Chart(std::string title, Axis x, Axis y, int width, int height)
    : title_(std::move(title)), x_(std::move(x)), y_(std::move(y)), width_(width), height_(height) {}

double Chart::x_at(double value) const {
    return kLeft + place(x_, value) * (width_ - kLeft - kRight);
}

double Chart::y_at(double value) const {
    return height_ - kBottom - place(y_, value) * (height_ - kTop - kBottom);
}

void Chart::add(Mark mark) {
    if (!std::isfinite(mark.x) || !std::isfinite(mark.y)) return;
    marks_ += fmt::format("<g {}>{}<title>{}</title></g>\n", mark.attributes,
                          shape(mark.series, x_at(mark.x), y_at(mark.y), mark.size, mark.is_hollow),
                          html_escaped(mark.tip));
    if (!mark.label.empty()) add_label(mark.label, x_at(mark.x), y_at(mark.y));
}

void Chart::add_label(const std::string& text, double x, double y) {
    constexpr double width = 16;
    constexpr double height = 11;
    for (const auto& [other_x, other_y] : labelled_)
        if (std::abs(other_x - x) < width && std::abs(other_y - y) < height) return;
    labelled_.emplace_back(x, y);
    beside_marks_ +=
        fmt::format(R"(<text x="{:.1f}" y="{:.1f}" font-size="10" pointer-events="none">{}</text>)"
                    "\n",
                    x + 7, y - 6, html_escaped(text));
}

void Chart::add_line(const std::vector<std::pair<double, double>>& points, int series) {
    std::string path;
    for (const auto& [x, y] : points)
        if (std::isfinite(y)) path += fmt::format("{:.1f},{:.1f} ", x_at(x), y_at(y));
    const Look look = series < 0 ? Look{"#000000", "", {}} : look_of(series);
    lines_ += fmt::format(
        R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="1.5" stroke-dasharray="{}"/>)"
        "\n",
        path, look.color, look.dash);
}

void Chart::add_steps(const std::vector<std::pair<double, double>>& points) {
    std::vector<std::pair<double, double>> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0) corners.emplace_back(points[i].first, points[i - 1].second);
        corners.push_back(points[i]);
    }
    add_line(corners, -1);
}

void Chart::add_legend(std::string label, int series, bool is_hollow) {
    legend_.push_back({std::move(label), series, is_hollow});
}

std::string Chart::axes() const {
    std::string text = fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#555"/>)"
                                   "\n",
                                   kLeft, kTop, width_ - kLeft - kRight, height_ - kTop - kBottom);
    for (const double tick : ticks_of(x_)) {
        const double x = x_at(tick);
        text += fmt::format(
            R"(<line x1="{0:.1f}" x2="{0:.1f}" y1="{1}" y2="{2}" stroke="#ddd"/><text x="{0:.1f}" y="{3}" text-anchor="middle">{4}</text>)"
            "\n",
            x, kTop, height_ - kBottom, height_ - kBottom + 17, tick_label(tick));
    }
    for (const double tick : ticks_of(y_)) {
        const double y = y_at(tick);
        text += fmt::format(
            R"(<line x1="{1}" x2="{2}" y1="{0:.1f}" y2="{0:.1f}" stroke="#ddd"/><text x="{3}" y="{4:.1f}" text-anchor="end">{5}</text>)"
            "\n",
            y, kLeft, width_ - kRight, kLeft - 6, y + 4, tick_label(tick));
    }
    text += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)"
                        "\n",
                        (kLeft + width_ - kRight) / 2, height_ - 14, html_escaped(x_.title));
    const int middle = (kTop + height_ - kBottom) / 2;
    text +=
        fmt::format(R"x(<text x="18" y="{0}" text-anchor="middle" transform="rotate(-90 18 {0})">{1}</text>)x"
                    "\n",
                    middle, html_escaped(y_.title));
    return text;
}

std::string Chart::legend() const {
    std::string text;
    const int rows = static_cast<int>(legend_.size());
    for (int i = 0; i < rows; ++i) {
        const Label& label = legend_[static_cast<std::size_t>(i)];
        const int y = height_ + 6 + i / 3 * kLegendRow;
        const int x = kLeft + i % 3 * (width_ - kLeft) / 3;
        text += label.series < 0
                    ? fmt::format(
                          R"(<line x1="{}" x2="{}" y1="{}" y2="{}" stroke="#000000" stroke-width="1.5"/>)",
                          x - 7, x + 7, y, y)
                    : shape(label.series, x, y, 5, label.is_hollow);
        text += fmt::format(R"(<text x="{}" y="{}">{}</text>)"
                            "\n",
                            x + 12, y + 4, html_escaped(label.text));
    }
    return text;
}

std::string Chart::svg(int top) const {
    const int rows = (static_cast<int>(legend_.size()) + 2) / 3;
    const int full = height_ + rows * kLegendRow;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\"{8} viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
        "fill=\"#ffffff\"/>\n"
        "<text x=\"{2}\" y=\"20\" font-size=\"14\" font-weight=\"bold\">{3}</text>\n{4}{5}{6}{7}</svg>\n",
        width_, full, kLeft, html_escaped(title_), axes(), lines_, marks_ + beside_marks_, legend(),
        top == 0 ? "" : fmt::format(" y=\"{}\"", top));
}

}  // namespace gobo::study
