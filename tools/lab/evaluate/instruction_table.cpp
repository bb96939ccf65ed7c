#include "lab/evaluate/instruction_table.hpp"

#include <algorithm>
#include <vector>

namespace gobo::evaluate {

std::span<const Row> instruction_table() {
    static const std::vector<Row> rows = [] {
        std::vector<Row> all;
        for (const auto part :
             {kFloatRows, kIntegerRows, kComparisonRows, kVectorRows, kMemoryRows, kImageRows, kWideRows})
            all.insert(all.end(), part.begin(), part.end());
        // Rows of the same code stay in order.
        std::ranges::stable_sort(all, {}, &Row::code);
        return all;
    }();
    return rows;
}

std::optional<std::uint32_t> find_row(std::uint32_t code) {
    const std::span<const Row> rows = instruction_table();
    const auto found = std::ranges::lower_bound(rows, code, {}, &Row::code);
    if (found == rows.end() || found->code != code) return std::nullopt;
    return static_cast<std::uint32_t>(found - rows.begin());
}

}  // namespace gobo::evaluate
