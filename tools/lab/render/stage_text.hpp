// What a driver compiles: the texts of a stage's pieces, one after the other.
#pragma once

#include <vector>

#include "compose/composition.hpp"

namespace gobo {

/// One stage with its pieces in order.
struct StageText {
    StageKind kind = StageKind::vertex;
    std::vector<Piece> pieces;
};

/// The pieces of one stage of a composition.
[[nodiscard]] StageText stage_text(const Composition& composition, int stage);

/// A stage of one text, named `name` in diagnostics.
[[nodiscard]] StageText stage_text(StageKind kind, const std::string& name, const std::string& text);

}  // namespace gobo
