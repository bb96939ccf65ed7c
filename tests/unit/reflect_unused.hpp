// What a stage declares and never uses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

/// The names, sorted, of blocks, samplers, plain uniforms, inputs and outputs that the stage declares but no
/// instruction of its functions uses. Built-in variables are left out; members of a block may be unused.
/// glslang drops functions that are never called, so what only they use is unused too.
[[nodiscard]] Result<std::vector<std::string>> unused_variables(const std::vector<std::uint32_t>& words);

}  // namespace gobo
