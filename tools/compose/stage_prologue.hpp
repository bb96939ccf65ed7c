// What stands in front of a stage: its version, its extensions, and the macros that it mentions.
#pragma once

#include <string>

#include "compose/dialect.hpp"
#include "compose/placing.hpp"

namespace gobo {

/// The text of a stage's prologue, of which it has what `mentions` holds for. `specialized` are the counts
/// that are specialisation constants in it, by feature with their constant_id; `library` holds the pieces.
[[nodiscard]] std::string stage_prologue(const Family& family, Dialect dialect, const Placement& placement,
                                         const Mentions& mentions, const PieceLibrary& library,
                                         const std::map<int, int>& specialized = {});

}  // namespace gobo
