// Stages as rows of a table, which takes far less than their lists: stages of a family are alike, and what
// they differ in stands at the same places.
#pragma once

#include <cstddef>
#include <vector>

namespace gobo {

using Numbers = std::vector<std::size_t>;

/// Lists of numbers as rows of one table: each column has a few distinct short lists, of which each row
/// chooses one; those chosen, one after the other, are the row's list.
struct StageColumns {
    std::vector<std::vector<Numbers>> columns;
    std::vector<Numbers> rows;  ///< for each list, by column, the index of the choice
};

/// The table of these lists, with at most `most` choices in a column (2 at least). The same lists in the same
/// order give the same table.
[[nodiscard]] StageColumns columns_of(const std::vector<Numbers>& lists, std::size_t most);

}  // namespace gobo
