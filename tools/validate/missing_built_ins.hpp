// What GLSL has built in and SPIR-V has not: glslang reads it as uniforms of other names.
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
/// Gives them their own names again.
void name_built_ins(Diagnostic& diagnostic);

}  // namespace gobo
