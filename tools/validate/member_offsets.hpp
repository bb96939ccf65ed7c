// Where members of blocks stand: std140, std430 and stated offsets.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "reflect/interface.hpp"
#include "spirv/module.hpp"

namespace gobo {

/// The first member that overlaps another of its block or stands out of order, and in Vulkan the first whose
/// stated offset its type does not allow, which glslang moves.
[[nodiscard]] Diagnostics check_member_offsets(const spirv::Module& module, const Interface& interface,
                                               const std::vector<const Piece*>& pieces, Dialect dialect);

}  // namespace gobo
