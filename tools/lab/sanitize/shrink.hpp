// Finds made simple.
#pragma once

#include "lab/sanitize/finding.hpp"

namespace gobo::sanitize {

/// The finding of a stage with every input that does not matter turned into a simple value of its domain (0,
/// 1, a unit vector, the identity, few digits) while it stays at its place with its message. Where it needs
/// its neighbour pixels, it is given back as it is.
[[nodiscard]] Finding simplified(const evaluate::Program& program, const InputSpace& space,
                                 OutputBounds& bounds, const Finding& finding);

}  // namespace gobo::sanitize
