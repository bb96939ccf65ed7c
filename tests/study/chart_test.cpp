// Charts: axes that hold their values, and marks where they belong.
#include <cmath>

#include <gtest/gtest.h>

#include "core/text.hpp"
#include "lab/study/front.hpp"
#include "lab/study/html.hpp"

namespace gobo::study {
namespace {

struct AxisRow {
    const char* name;
    std::vector<double> values;
    double least;
    double low, high;
};

class AxisFor : public testing::TestWithParam<AxisRow> {};

TEST_P(AxisFor, HoldsAllValues) {
    const Axis axis = axis_for("x", GetParam().values, GetParam().least);
    EXPECT_NEAR(axis.low, GetParam().low, 1e-9 * std::abs(GetParam().low));
    EXPECT_NEAR(axis.high, GetParam().high, 1e-9 * std::abs(GetParam().high));
}

INSTANTIATE_TEST_SUITE_P(
    Rows, AxisFor,
    testing::Values(AxisRow{"nothing", {}, 0, 0.1, 1}, AxisRow{"ends_are_round", {3, 250}, 1, 2, 500},
                    AxisRow{"one_value_has_room", {5}, 1, 2, 10},
                    AxisRow{"zeros_stand_at_the_least", {0, 0.5}, 1e-3, 1e-3, 1},
                    AxisRow{"infinite_errors_stretch_nothing", {1, HUGE_VAL, 20}, 1, 1, 50}),
    [](const auto& row) { return row.param.name; });

TEST(Html, IsEscaped) {
    EXPECT_EQ(html_escaped("a < b && \"c\" > d"), "a &lt; b &amp;&amp; &quot;c&quot; &gt; d");
}

TEST(Chart, NamesItsMarksAndEscapesThem) {
    Chart chart("a < b", {"cost, additions", 1, 10}, {"error", 1e-3, 1});
    chart.add({5, 0.1, 1, false, 4, "class=\"point\"", "shading=\"vertex\" & more"});
    const std::string svg = chart.svg();
    EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
    EXPECT_NE(svg.find("<title>shading=&quot;vertex&quot; &amp; more</title>"), std::string::npos);
    EXPECT_NE(svg.find("class=\"point\""), std::string::npos);
    EXPECT_NE(svg.find("cost, additions"), std::string::npos);
}

struct NumberRow {
    double number;
    const char* text;
};

class ShortNumber : public testing::TestWithParam<NumberRow> {};

TEST_P(ShortNumber, IsForReaders) {
    EXPECT_EQ(short_number(GetParam().number), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(Rows, ShortNumber,
                         testing::Values(NumberRow{0, "0"}, NumberRow{0.012345, "0.0123"},
                                         NumberRow{1.26e-7, "1.3e-07"}, NumberRow{999.4, "999"},
                                         NumberRow{999.6, "1000"}, NumberRow{12345.6, "12346"},
                                         NumberRow{2.5e6, "2.5e+06"}));

TEST(Chart, LabelsWhatHasRoomForIt) {
    Chart chart("t", {"x", 0.1, 1}, {"y", 0.1, 1});
    chart.add({0.5, 0.5, 0, false, 4, "", "", "first"});
    chart.add({0.501, 0.5, 0, false, 4, "", "", "covered"});
    chart.add({0.8, 0.5, 0, false, 4, "", "", "beside"});
    const std::string svg = chart.svg();
    EXPECT_NE(svg.find(">first</text>"), std::string::npos);
    EXPECT_EQ(svg.find(">covered</text>"), std::string::npos);
    EXPECT_NE(svg.find(">beside</text>"), std::string::npos);
}

TEST(Chart, LeavesOutWhatHasNoPlace) {
    Chart chart("t", {"x", 0.1, 1}, {"y", 0.1, 1});
    const std::string empty = chart.svg();
    chart.add({NAN, 0.5, 0, false, 4, "", "none"});
    EXPECT_EQ(chart.svg(), empty);
}

}  // namespace
}  // namespace gobo::study
