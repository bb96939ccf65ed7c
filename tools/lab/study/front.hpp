// The front of a finished study, for readers: a short table, and a chart of error against cost. Charts are
// SVG, readable in print and by the colour-blind: every series has a colour, a shape and a dash of its own.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lab/study/rows.hpp"

namespace gobo::study {

/// A logarithmic axis.
struct Axis {
    std::string title;  ///< with its unit
    double low = 0.1;
    double high = 1;  ///< above `low`
};

/// An axis that holds all values and a little more. It ends at 1, 2 or 5 of a decade and takes what is not
/// above `least` as `least`.
[[nodiscard]] Axis axis_for(std::string title, const std::vector<double>& values, double least);

/// How a series looks. Colours: Okabe and Ito, Color Universal Design, 2008.
inline constexpr int kSeries = 7;

struct Mark {
    double x = 0;
    double y = 0;
    int series = 0;          ///< modulo kSeries
    bool is_hollow = false;  ///< an outline in the series' colour
    double size = 5;         ///< pixels from the centre to the edge
    std::string attributes;  ///< of the mark's group, escaped
    std::string tip;         ///< what it is, for the pointer and for screen readers
    std::string label = {};  ///< beside it, unless an earlier label is in the way
};

class Chart {
  public:
    Chart(std::string title, Axis x, Axis y, int width = 720, int height = 440);

    void add(Mark mark);
    /// A line through the points in their order; `series` below 0 is black and solid.
    void add_line(const std::vector<std::pair<double, double>>& points, int series);
    /// From point to point along the axes, as a front runs: right, then down.
    void add_steps(const std::vector<std::pair<double, double>>& points);
    /// `series` below 0 stands for the black line.
    void add_legend(std::string label, int series, bool is_hollow = false);

    /// An <svg> element that stands alone as a file too; within another one it begins `top` pixels down.
    [[nodiscard]] std::string svg(int top = 0) const;

  private:
    [[nodiscard]] double x_at(double value) const;
    [[nodiscard]] double y_at(double value) const;
    void add_label(const std::string& text, double x, double y);
    [[nodiscard]] std::string axes() const;
    [[nodiscard]] std::string legend() const;

    struct Label {
        std::string text;
        int series = 0;
        bool is_hollow = false;
    };

    std::string title_;
    Axis x_, y_;
    int width_, height_;
    std::string lines_;
    std::string marks_;
    std::string beside_marks_;  ///< their labels
    std::vector<std::pair<double, double>> labelled_;
    std::vector<Label> legend_;
};

/// The feature that colours the points: the first that says where light is computed, else the first quality;
/// -1 where there is none.
[[nodiscard]] int coloured_feature(const Family& family, const std::vector<std::string>& rate);

/// What is on the front, most accurate first. Of rows whose errors are alike, nothing but roundings (within
/// kChance times those of the most accurate one) on the scenes and over the domain, the cheapest.
[[nodiscard]] std::vector<const StudyRow*> front_of(const std::vector<const StudyRow*>& rows);

/// A table in Markdown, of at most six lines: the most accurate quality on the front, then for each power of
/// ten of the error the cheapest within it, then what lies furthest between.
[[nodiscard]] std::string front_table(const std::vector<StudyRow>& rows);

/// Error against cost. `rate` are the features that say where light is computed: the first one colours the
/// points. What is on the front is numbered in the order of front_of().
[[nodiscard]] Chart front_chart(const Family& family, const std::vector<std::string>& rate,
                                const std::vector<const StudyRow*>& rows, std::string title);

/// "12.3 (11.9 to 12.8)".
[[nodiscard]] std::string spread_text(const Spread& spread);

}  // namespace gobo::study
