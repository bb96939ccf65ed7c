// What glslang takes although the stage's version of GLSL, or OpenGL, has it not: drivers refuse it.
#pragma once

#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "validate/active_text.hpp"

namespace gobo {

/// Errors of what the stage's active lines say: names and layout qualifiers of later versions or of Vulkan,
/// extensions that OpenGL has not, macros that make strings, functions declared within others. The first
/// piece is the prologue, which states version and extensions; `text` is that of the pieces.
[[nodiscard]] Diagnostics check_language(StageKind kind, const std::vector<const Piece*>& pieces,
                                         const ActiveText& text, Dialect dialect);

/// Whether a name says something to check_language() wherever it stands.
[[nodiscard]] bool is_noted(std::string_view name);

}  // namespace gobo
