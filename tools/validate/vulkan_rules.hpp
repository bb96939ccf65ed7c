// What Vulkan 1.0 lacks and glslang takes all the same within one stage.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// Errors: samplers and images in arrays of arrays or of rectangles; vertex inputs that share a location,
/// which each has one VkVertexInputAttributeDescription.
[[nodiscard]] Diagnostics check_vulkan(StageKind kind, const Interface& interface,
                                       const std::vector<const Piece*>& pieces);

}  // namespace gobo
