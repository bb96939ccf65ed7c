// SPIRV-Tools' validator as a second opinion on what glslang made.
#pragma once

#include "core/diagnostic.hpp"
#include "validate/validated.hpp"

namespace gobo {

/// What spirv-val says of a module under OpenGL 4.5's rules; empty where it is valid.
[[nodiscard]] Diagnostics spirv_val(const SpirvModule& module, const Place& place);

}  // namespace gobo
