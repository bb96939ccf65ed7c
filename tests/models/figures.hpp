// What `gobo test --figures FILE` wrote: each permutation with its errors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo::models {

/// One permutation. Errors are relative to the largest term (docs/verification.md).
struct PermutationFigures {
    std::string key;
    std::uint64_t points = 0;
    double fp32 = 0;
    double fp64 = 0;
};

/// A run over one family.
struct Figures {
    std::string family;
    std::vector<PermutationFigures> permutations;
};

[[nodiscard]] Result<Figures> read_figures(std::string_view json, const std::string& path);

}  // namespace gobo::models
