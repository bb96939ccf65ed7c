// OpenGL's uniforms outside blocks, which Vulkan lacks, gathered in a block.
#pragma once

#include <string>
#include <vector>

#include "lab/cost/pipeline.hpp"
#include "spirv/module.hpp"

namespace gobo::cost {

/// The module with its uniforms outside blocks as members of one uniform block of that name, laid out as
/// std140; samplers and images stay what they are, and so does a module without such uniforms. Booleans
/// become whole numbers, as in any block. Errors: structs that hold samplers, booleans that are read with
/// the array or struct around them.
[[nodiscard]] Result<Words> with_uniform_block(const spirv::Module& module, const Words& words,
                                               const std::string& name);

}  // namespace gobo::cost
