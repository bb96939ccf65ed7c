// One run of a stage, watched.
#pragma once

#include <span>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/sanitize/finding.hpp"
#include "lab/sanitize/output_bounds.hpp"

namespace gobo::sanitize {

/// The traps of one stage at the given points; the stage's kind is left to the caller. An output that nothing
/// ever stores to has no place. `bounds` are those of OutputBounds::at(), or empty: points that trap are not
/// held to them. `also` watches beside the traps.
[[nodiscard]] Result<std::vector<Finding>> find_traps(const evaluate::Program& program,
                                                      const evaluate::Invocations& invocations,
                                                      Machine machine, std::span<const Interval> bounds = {},
                                                      evaluate::Observer<float>* also = nullptr);

}  // namespace gobo::sanitize
