// Makes the input of a finding simple.
#pragma once

#include "lab/sanitize/finding.hpp"
#include "lab/sanitize/output_bounds.hpp"

namespace gobo::sanitize {

/// The finding with every input that does not matter turned into a simple value of its domain (0, 1, a unit
/// vector, the identity, few digits) while it stays at its place with its message. Where it needs its
/// neighbour pixels, it is given back as it is.
[[nodiscard]] Finding shrunk(const evaluate::Program& program, const InputSpace& space, OutputBounds& bounds,
                             const Finding& finding);

}  // namespace gobo::sanitize
