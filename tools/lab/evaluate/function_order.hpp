// In which order blocks run, and how long values live. Internal to evaluation.
#pragma once

#include <unordered_map>
#include <vector>

#include "lab/evaluate/module.hpp"

namespace gobo::evaluate {

/// The function's reachable blocks (indices), so that whoever leaves a construct waits at a later block than
/// those who stay inside: reverse post-order in which the block where a construct merges comes after all of
/// its content, and a loop's continue block after its body. Running the earliest block that any lane waits at
/// then brings lanes together again. Labels that name no block are left out.
[[nodiscard]] std::vector<std::size_t> structured_order(const Function& function);

/// Where an id is used inside its function.
struct Uses {
    std::size_t block = 0;    ///< that defines it
    std::uint32_t count = 0;  ///< of operands that name it
    bool is_local = true;     ///< all in the block that defines it
    std::uint32_t last = 0;   ///< instruction of the last use in that block
};

using UsesById = std::unordered_map<std::uint32_t, Uses>;

/// Of the ids that the function defines. An operand of OpPhi is used at the end of the block it comes from.
[[nodiscard]] UsesById uses_in(const Module& module, const Function& function);

}  // namespace gobo::evaluate
