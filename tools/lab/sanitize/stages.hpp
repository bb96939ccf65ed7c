// Going through the stages of a composition.
#pragma once

#include <functional>
#include <vector>

#include "compose/composition.hpp"

namespace gobo::sanitize {

/// Calls work(0) to work(count - 1), in any order, from `jobs` threads.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

/// The permutations that share the stage, as indices.
[[nodiscard]] std::vector<std::size_t> permutations_of(const Composition& composition, std::size_t stage);

}  // namespace gobo::sanitize
