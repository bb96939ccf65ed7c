// Medians, quartiles and rank correlations of known lists.
#include "lab/study/statistics.hpp"

#include <gtest/gtest.h>

namespace gobo::study {
namespace {

struct SpreadRow {
    const char* name;
    std::vector<double> values;
    Spread expected;
};

class SpreadOf : public testing::TestWithParam<SpreadRow> {};

TEST_P(SpreadOf, IsMedianAndQuartiles) {
    EXPECT_EQ(spread_of(GetParam().values), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, SpreadOf,
    testing::Values(SpreadRow{"nothing", {}, {0, 0, 0}}, SpreadRow{"one", {4}, {4, 4, 4}},
                    SpreadRow{"five_in_any_order", {5, 1, 4, 2, 3}, {3, 2, 4}},
                    SpreadRow{"between_ranks", {1, 2, 3, 4}, {2.5, 1.75, 3.25}},
                    SpreadRow{"an_outlier_moves_nothing", {1, 2, 3, 4, 1000}, {3, 2, 4}}),
    [](const auto& row) { return row.param.name; });

TEST(Spread, OverlapsWhereMiddleHalvesShareAValue) {
    EXPECT_TRUE((Spread{2, 1, 3}.overlaps({4, 3, 5})));
    EXPECT_TRUE((Spread{4, 3, 5}.overlaps({2, 1, 3})));
    EXPECT_FALSE((Spread{2, 1, 3}.overlaps({4, 3.5, 5})));
}

struct CorrelationRow {
    const char* name;
    std::vector<double> first, second;
    double expected;
};

class RankCorrelation : public testing::TestWithParam<CorrelationRow> {};

TEST_P(RankCorrelation, IsSpearmans) {
    EXPECT_NEAR(rank_correlation(GetParam().first, GetParam().second), GetParam().expected, 1e-12);
}

// The last two by hand: 1 - 6 sum d^2 / (n (n^2 - 1)) without ties; Pearson's of the mean ranks with.
INSTANTIATE_TEST_SUITE_P(Rows, RankCorrelation,
                         testing::Values(CorrelationRow{"same_order", {1, 2, 3, 9}, {10, 20, 300, 4000}, 1},
                                         CorrelationRow{"reversed", {1, 2, 3}, {3, 2, 1}, -1},
                                         CorrelationRow{"too_few", {1, 2}, {1, 2}, 0},
                                         CorrelationRow{"one_side_constant", {1, 2, 3}, {7, 7, 7}, 0},
                                         CorrelationRow{"one_swap", {1, 2, 3, 4}, {1, 3, 2, 4}, 0.8},
                                         CorrelationRow{"a_tie", {1, 1, 2}, {1, 2, 3}, 0.8660254037844386}),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo::study
