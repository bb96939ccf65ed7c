#include "lab/study/front_chart.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "family/key.hpp"
#include "lab/study/front_table.hpp"
#include "budget/qualities.hpp"
#include "lab/study/time_study.hpp"

namespace gobo::study {
namespace {

/// Errors below are drawn as this: what is exact has no place on a logarithmic axis.
constexpr double kLeastShown = 1e-8;

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

/// Puts rows of a study into a chart.
class FrontPlotter {
  public:
    FrontPlotter(const Family& family, int coloured, Chart& chart)
        : family_(family), coloured_(coloured), chart_(chart), used_(kSeries) {}

    void add_row(const StudyRow& row, const std::string& label) {
        const Key key = parse_key(family_, row.key).value();
        const int series = coloured_ < 0 ? 0 : key[static_cast<std::size_t>(coloured_)];
        used_[static_cast<std::size_t>(series) % used_.size()] = true;
        chart_.add({row.costs.total, std::max(row.error.max, kLeastShown), series, !row.on_front,
                    row.on_front ? 6.0 : 4.0,
                    fmt::format(R"(class="point" tabindex="0" data-key="{}" data-values="{}")",
                                escaped(row.key), value_numbers(family_, key)),
                    tip_of(row), label});
    }

    /// The front's rows, numbered, and the steps between them.
    void add_front(const std::vector<const StudyRow*>& front) {
        std::vector<std::pair<double, double>> corners;
        for (std::size_t i = 0; i < front.size(); ++i) {
            add_row(*front[i], std::to_string(i + 1));
            corners.emplace_back(front[i]->costs.total, std::max(front[i]->error.max, kLeastShown));
        }
        std::reverse(corners.begin(), corners.end());
        chart_.add_steps(corners);
    }

    void add_legend() {
        for (std::size_t value = 0; coloured_ >= 0 && value < used_.size(); ++value) {
            const Feature& coloured = family_.features[static_cast<std::size_t>(coloured_)];
            if (used_[value])
                chart_.add_legend(fmt::format("{}={}", coloured.name, coloured.values[value]),
                                  static_cast<int>(value));
        }
        chart_.add_legend("front: nothing is better in both", -1);
        chart_.add_legend("hollow: dominated", 0, true);
    }

  private:
    const Family& family_;
    int coloured_;
    Chart& chart_;
    std::vector<bool> used_;
};

}  // namespace

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
    FrontPlotter plotter(family, coloured_feature(family, rate), chart);
    // Dominated ones first, so that the front lies on top.
    for (const StudyRow* row : rows)
        if (!row->on_front) plotter.add_row(*row, "");
    plotter.add_front(front_of(rows));
    plotter.add_legend();
    return chart;
}

}  // namespace gobo::study
