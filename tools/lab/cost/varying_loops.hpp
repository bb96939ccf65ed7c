// Loops of a stage whose number of turns is not written in it: compilers guess it.
#pragma once

#include "spirv/module.hpp"

namespace gobo::cost {

/// Whether a function has a loop that ends otherwise than by a counter that goes from a constant by constant
/// steps to a constant. Drivers unroll such loops too, up to a largest number of turns, and weigh each
/// further turn as less likely: nothing in the assembly shows it then. For SPIR-V as glslang makes it,
/// counters in variables.
[[nodiscard]] bool has_varying_loop(const spirv::Module& module);

}  // namespace gobo::cost
