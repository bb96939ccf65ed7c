// Comparisons as sets of outcomes.
#pragma once

#include <cstdint>

namespace gobo::prove {

/// How two numbers may compare.
enum Outcome : int { kLess = 1, kEqual = 2, kGreater = 4, kUnordered = 8, kAllOutcomes = 15 };

struct Comparison {
    std::uint32_t code;
    int when_true;  ///< outcomes
    bool is_unsigned = false;
};

/// nullptr where the code is of no comparison.
[[nodiscard]] const Comparison* comparison_of(std::uint32_t code);

}  // namespace gobo::prove
