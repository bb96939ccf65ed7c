// What GLSL has built in and SPIR-V has not, which glslang reads as uniforms of other names; and the macros
// that glslang alone defines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compose/dialect.hpp"
#include "compose/rewrite.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

/// The names that a stage mentions, with those that take their place, and what declares these.
struct MissingBuiltIns {
    Substitutions renamed;
    std::string declarations;  ///< for the end of the prologue
};

/// Those of a stage that its version, or an extension that the prologue states, has: `gl_DepthRange`,
/// `gl_NumSamples`, and before GLSL 4.40 `gl_DrawIDARB` and its like.
[[nodiscard]] MissingBuiltIns missing_built_ins(StageKind stage, const std::string& prologue,
                                                const std::vector<const Piece*>& pieces);

/// Whether a uniform is one of those.
[[nodiscard]] bool is_missing_built_in(std::string_view uniform);
/// The text with other names for the macros that glslang defines and no driver of OpenGL does: `GL_SPIRV`,
/// and those of extensions that Vulkan or tools alone have. Its `#extension` lines stay as they are.
[[nodiscard]] std::string without_foreign_macros(std::string_view text);
/// Gives them, and the macros, their own names again.
void name_built_ins(Diagnostic& diagnostic);

}  // namespace gobo
