// What SPIRV-Tools' validator says of the modules that glslang makes, in terms of the source.
#pragma once

#include <span>
#include <vector>

#include <spirv-tools/libspirv.hpp>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

/// Whose rules the validator goes by.
[[nodiscard]] spv_target_env environment_of(Dialect dialect);

/// What the validator says of a module with names: errors of the input, which asks for what the environment
/// lacks, at the first line that declares what the validator names. Empty where the module is valid.
[[nodiscard]] Diagnostics check_module(const std::vector<std::uint32_t>& module, spv_target_env environment,
                                       const std::vector<const Piece*>& pieces);

/// An error of gobo's own where the optimizer has made a module that is not valid.
[[nodiscard]] Result<void> refuse_optimized(const std::vector<std::uint32_t>& module,
                                            spv_target_env environment);

/// Errors of the capabilities that the dialect lacks and glslang gives to a module all the same: in SPIR-V
/// that is shipped subgroups, and pointers to buffers, which gobo's reader of SPIR-V does not know; in OpenGL
/// ray queries and cooperative matrices.
[[nodiscard]] Result<void> refuse_capabilities(std::span<const std::uint32_t> module,
                                               const std::vector<const Piece*>& pieces, Dialect dialect);

}  // namespace gobo
