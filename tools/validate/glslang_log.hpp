// glslang's messages as diagnostics.
#pragma once

#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "compose/composition.hpp"

namespace gobo {

/// Reads the lines of an info log. A message that names one of the pieces gets that piece's path and line,
/// with the line quoted; the rest (those of linking) stand at `otherwise`. Lines that only say how many
/// errors there were are left out.
[[nodiscard]] Diagnostics diagnostics_of_log(std::string_view log, const std::vector<const Piece*>& pieces,
                                             const Place& otherwise);

}  // namespace gobo
