#include "lab/evaluate/instruction_table.hpp"

#include <algorithm>
#include <vector>

namespace gobo::evaluate {
namespace {

std::vector<Row> all_rows() {
    std::vector<Row> rows;
    for (const auto part :
         {float_rows(), integer_rows(), comparison_rows(), vector_rows(), memory_rows(), image_rows()})
        rows.insert(rows.end(), part.begin(), part.end());
    // Rows of the same code stay in order.
    std::ranges::stable_sort(rows, {}, &Row::code);
    return rows;
}

}  // namespace

std::span<const Row> instruction_table() {
    static const std::vector<Row> rows = all_rows();
    return rows;
}

std::optional<std::uint32_t> find_row(std::uint32_t code) {
    const std::span<const Row> rows = instruction_table();
    const auto found = std::ranges::lower_bound(rows, code, {}, &Row::code);
    if (found == rows.end() || found->code != code) return std::nullopt;
    return static_cast<std::uint32_t>(found - rows.begin());
}

}  // namespace gobo::evaluate
