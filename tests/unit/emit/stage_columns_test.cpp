// Lists of numbers as rows of a table.
#include "emit/stage_columns.hpp"

#include <gtest/gtest.h>

namespace gobo {
namespace {

/// The lists of the rows again.
std::vector<Numbers> lists_of(const StageColumns& table) {
    std::vector<Numbers> lists;
    for (const Numbers& row : table.rows) {
        Numbers& list = lists.emplace_back();
        for (std::size_t column = 0; column < row.size(); ++column) {
            const Numbers& chosen = table.columns.at(column).at(row[column]);
            list.insert(list.end(), chosen.begin(), chosen.end());
        }
    }
    return lists;
}

struct Row {
    const char* name;
    std::vector<Numbers> lists;
    std::size_t most;
    std::size_t columns;
};

class Columns : public testing::TestWithParam<Row> {};

TEST_P(Columns, GiveTheListsBack) {
    const StageColumns table = columns_of(GetParam().lists, GetParam().most);
    EXPECT_EQ(lists_of(table), GetParam().lists);
    EXPECT_EQ(table.columns.size(), GetParam().columns);
    for (const std::vector<Numbers>& column : table.columns) EXPECT_LE(column.size(), GetParam().most);
}

INSTANTIATE_TEST_SUITE_P(
    Lists, Columns,
    testing::Values(Row{"none", {}, 64, 0}, Row{"empty", {{}, {}}, 64, 0},
                    Row{"alike", {{1, 2, 3}, {1, 2, 3}}, 64, 1},
                    Row{"one_differs", {{1, 2, 4}, {1, 3, 4}, {1, 4}}, 64, 1},
                    Row{"independent", {{1, 5, 3}, {2, 5, 3}, {1, 5, 4}, {2, 5, 4}}, 2, 2},
                    Row{"repeated_numbers", {{1, 1, 1, 2}, {1, 1, 2, 1}, {2, 1, 1}}, 64, 1},
                    Row{"in_no_common_order", {{1, 2, 3}, {3, 2, 1}, {2, 3, 1}}, 2, 3},
                    Row{"nothing_in_common", {{1}, {2}, {3}, {}}, 2, 3}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(Columns, OfManyListsThatDifferIndependently) {
    std::vector<Numbers> lists;
    for (std::size_t number = 0; number < 4096; ++number) {
        Numbers& list = lists.emplace_back();
        for (std::size_t bit = 0; bit < 12; ++bit) {
            list.push_back(100 + bit);
            if ((number >> bit) % 2 == 1) list.push_back(bit);
        }
    }
    const StageColumns table = columns_of(lists, 64);
    EXPECT_EQ(lists_of(table), lists);
    EXPECT_EQ(table.columns.size(), 2U);
}

}  // namespace
}  // namespace gobo
