// Errors whose cause stands in an earlier piece: glslang meets a missing `;` or `}` only in the next one.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

/// What glslang found in a stage. Where a piece's last declaration lacks its `;`, or a bracket its end, and
/// a later piece was blamed, one error at that piece's last line of code in place of what follows from it.
/// Within a file a missing `;` is told at the line that lacks it, where glslang names the next line's first
/// token.
[[nodiscard]] Diagnostics with_missing_ends(Diagnostics found, const std::vector<const Piece*>& pieces);

}  // namespace gobo
