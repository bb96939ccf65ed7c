// Which of some points lie on the Pareto front, and by which the others are dominated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/study/statistics.hpp"

namespace gobo::study {
namespace {

constexpr int kFront = -1;

struct FrontRow {
    const char* name;
    std::vector<Priced> points;   ///< cost, error
    std::vector<int> dominators;  ///< kFront, or the index of a point
};

class Front : public testing::TestWithParam<FrontRow> {};

TEST_P(Front, IsWhatNothingDominates) {
    std::vector<int> found;
    for (const auto& by : dominators(GetParam().points)) found.push_back(by ? static_cast<int>(*by) : kFront);
    EXPECT_EQ(found, GetParam().dominators);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, Front,
    testing::Values(FrontRow{"a_trade", {{1, 2}, {2, 1}}, {kFront, kFront}},
                    FrontRow{"dearer_and_less_accurate", {{1, 1}, {2, 2}}, {kFront, 0}},
                    FrontRow{"dearer_alone", {{1, 1}, {2, 1}}, {kFront, 0}},
                    FrontRow{"less_accurate_alone", {{1, 2}, {1, 1}}, {1, kFront}},
                    FrontRow{"twins_both_stay", {{1, 1}, {1, 1}}, {kFront, kFront}},
                    FrontRow{"a_chain_names_its_end", {{3, 3}, {2, 2}, {1, 1}}, {2, 2, kFront}}),
    [](const auto& row) { return row.param.name; });

TEST(NearFront, ForgivesAsMuchAsItIsTold) {
    const std::vector<Priced> points = {{100, 1}, {105, 1.4}, {105, 2}, {200, 1.4}, {200, 2}};
    EXPECT_THAT(near_front(points, 1.1, 1.5), testing::ElementsAre(true, true, true, true, false));
    EXPECT_THAT(near_front(points, 1, 1), testing::ElementsAre(true, false, false, false, false));
}

}  // namespace
}  // namespace gobo::study
