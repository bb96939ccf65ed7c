// What only glslang's syntax tree says of a stage: SPIR-V holds no precision but in OpenGL ES from 3.10 on,
// and no function that main() does not reach. `tree` is what glslang prints of the pieces when it is told
// EShMsgAST, since the headers of the tree itself are not packaged everywhere.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "reflect/interface.hpp"
#include "validate/active_text.hpp"

namespace gobo {

/// Whether there may be something to read from the tree: uniforms with a precision, or functions that are
/// declared without a body.
[[nodiscard]] bool asks_for_tree(const std::vector<const Piece*>& pieces, ReadPieces& read);

/// "highp", "mediump" or "lowp" by the name of a uniform, "lamps.color" of a member, without indices.
using Precisions = std::map<std::string, std::string, std::less<>>;

/// Those of uniforms outside blocks, stated or by default, of a stage of OpenGL ES.
[[nodiscard]] Precisions precisions_of(std::string_view tree);

/// Puts the precisions into uniforms, their members and samplers.
void set_precisions(Interface& interface, const Precisions& precisions);

/// Functions without a body that another one calls, even where main() never comes there: drivers refuse to
/// link it, glslang only looks at what main() reaches.
[[nodiscard]] Diagnostics check_calls(std::string_view tree, const std::vector<const Piece*>& pieces);

}  // namespace gobo
