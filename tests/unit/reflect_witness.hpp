// An independent witness of reflection: what spirv-cross says about the same module.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reflect/interface.hpp"

namespace gobo::testing {

/// The facts that both sides know, one a line, sorted: blocks with every member's layout, samplers, images,
/// inputs and outputs. spirv-cross does not list plain uniforms, nor locations inside structs.
[[nodiscard]] std::vector<std::string> facts_of(const Interface& interface);

/// The same lines from `spirv-cross FILE --reflect`, run on a temporary file called `name`.
[[nodiscard]] std::vector<std::string> facts_of_spirv_cross(const std::vector<std::uint32_t>& spirv,
                                                            const std::string& name);

}  // namespace gobo::testing
