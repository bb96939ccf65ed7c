// The guards of the pieces that only `pbr` has, and the cases that fail without them.
#pragma once

#include <vector>

#include "lit_guards.hpp"

namespace gobo {

/// Cases of the family `pbr`.
[[nodiscard]] const std::vector<Case>& pbr_cases();

/// Each is needed by one of pbr_cases().
[[nodiscard]] const std::vector<Guard>& pbr_guards();

/// Those of `lit`, then those of `pbr`; each has a name of its own.
[[nodiscard]] std::vector<Guard> all_guards();

}  // namespace gobo
