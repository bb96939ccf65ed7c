// The cases of switches, which OpenGL's drivers take more strictly than glslang.
#pragma once

#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

/// Whether the pieces have a `switch` under rules that want each `case` of its type: all before GLSL 4.00,
/// and GLSL ES.
[[nodiscard]] bool has_strict_switches(const std::vector<const Piece*>& pieces);

/// An error for each `case` whose type is not that of what its `switch` looks at. `tree` is what glslang
/// prints of the pieces when it is told EShMsgAST: SPIR-V does not keep these types, and the headers of the
/// tree itself are not packaged everywhere.
[[nodiscard]] Diagnostics check_switches(std::string_view tree, const std::vector<const Piece*>& pieces);

}  // namespace gobo
