// What glslang's tree of a stage shows of it that SPIR-V no longer does.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"

namespace glslang {
class TIntermediate;
}

namespace gobo {

/// An error for each `case` whose type is not that of what its `switch` looks at, which GLSL allows from 4.00
/// on and GLSL ES never. The pieces are the strings that were parsed.
[[nodiscard]] Diagnostics check_tree(const glslang::TIntermediate& tree,
                                     const std::vector<const Piece*>& pieces);

}  // namespace gobo
