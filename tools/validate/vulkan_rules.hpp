// What Vulkan 1.0 lacks and glslang takes all the same within one stage.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// Errors: samplers and images in arrays of arrays or of rectangles; vertex inputs that share a location,
/// which each has one VkVertexInputAttributeDescription.
[[nodiscard]] Diagnostics check_vulkan(StageKind kind, const Interface& interface,
                                       const std::vector<const Piece*>& pieces);

/// What the stage's text calls its resources and push constants: samplers, blocks, their instances, and the
/// members of those without an instance.
[[nodiscard]] std::set<std::string> names_of_resources(const std::vector<const Piece*>& pieces);

}  // namespace gobo
