// What stands in front of a stage: its version, its extensions, and the macros that it mentions.
#pragma once

#include <string>

#include "compose/dialect.hpp"
#include "compose/placing.hpp"

namespace gobo {

/// The text of a stage's prologue, of which it has what `mentions` holds for.
[[nodiscard]] std::string stage_prologue(const Family& family, Dialect dialect, const Placement& placement,
                                         const Mentions& mentions);

}  // namespace gobo
