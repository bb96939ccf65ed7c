#include "lab/evaluate/instruction_table.hpp"

#include <algorithm>
#include <vector>

namespace gobo::evaluate {
namespace {

std::vector<Row> all_rows() {
    std::vector<Row> rows;
    for (const std::span<const Row> part :
         {arithmetic_rows(), integer_rows(), comparison_rows(), conversion_rows(), matrix_rows(),
          memory_rows(), elementary_rows(), geometric_rows(), packing_rows(), quad_rows(), image_rows()})
        rows.insert(rows.end(), part.begin(), part.end());
    // Rows of the same code stay in order.
    std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.code < b.code; });
    return rows;
}

}  // namespace

std::span<const Row> instruction_table() {
    static const std::vector<Row> rows = all_rows();
    return rows;
}

std::optional<std::uint32_t> find_row(std::uint32_t code) {
    const std::span<const Row> rows = instruction_table();
    const auto found =
        std::lower_bound(rows.begin(), rows.end(), code,
                         [](const Row& row, std::uint32_t wanted) { return row.code < wanted; });
    if (found == rows.end() || found->code != code) return std::nullopt;
    return static_cast<std::uint32_t>(found - rows.begin());
}

}  // namespace gobo::evaluate
