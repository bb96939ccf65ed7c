// What stages may each call by a name of their own, since it goes by its place.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compose/composition.hpp"

namespace gobo {

/// Of the inputs and outputs, but for blocks, those for which two stages' texts state other locations.
[[nodiscard]] std::set<std::string> names_at_two_locations(
    const std::vector<std::vector<const Piece*>>& stages);

/// What the stage's text calls its resources and push constants: samplers, blocks, their instances, and the
/// members of those without an instance. In Vulkan they go by set and binding.
[[nodiscard]] std::set<std::string> names_of_resources(const std::vector<const Piece*>& pieces);

}  // namespace gobo
