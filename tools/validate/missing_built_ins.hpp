// What GLSL has built in and SPIR-V has not, which glslang reads as variables of other names; and the macros
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
/// `gl_NumSamples`, before GLSL 4.40 `gl_DrawIDARB` and its like, and before 1.40 or in the compatibility
/// profile `gl_ClipVertex`.
[[nodiscard]] MissingBuiltIns missing_built_ins(StageKind stage, const std::string& prologue,
                                                const std::vector<const Piece*>& pieces);

/// Whether all errors are that a function is called with an image that has a format.
[[nodiscard]] bool are_of_formats(const Diagnostics& found);
/// Whether a word of a layout is the format of an image: "rgba8".
[[nodiscard]] bool is_image_format(std::string_view word);

/// The text without the formats of images: glslang wants a function's parameter, which can state none, to
/// have that of what it is called with.
[[nodiscard]] std::string without_formats(std::string_view text);

/// Whether a uniform is one of those.
[[nodiscard]] bool is_missing_built_in(std::string_view uniform);

/// For the end of the prologue: functions that an extension brings and glslang lacks, as fma() before GLSL
/// 4.00, and the macros that with_driver_macros() names.
[[nodiscard]] std::string driver_declarations(const std::string& prologue,
                                              const std::vector<const Piece*>& pieces);

/// The text with other names for the macros that glslang defines and no driver of OpenGL does: `GL_SPIRV`,
/// and those of extensions that Vulkan or tools alone have. Its `#extension` lines stay as they are.
[[nodiscard]] std::string without_foreign_macros(std::string_view text);
/// That, with the macros of extensions that drivers have and glslang does not know as 1, and with the macros
/// that driver_declarations() gives the values of the shader's own version.
[[nodiscard]] std::string with_driver_macros(std::string_view text);
/// The text without `shared` and `packed` in layouts, of which glslang makes no SPIR-V: blocks that state no
/// layout are laid out so, too.
[[nodiscard]] std::string without_own_layouts(std::string text);
/// Whether one of the two may change the text.
[[nodiscard]] bool differs_from_drivers(std::string_view text);
/// Gives them, and the macros, their own names again.
void name_built_ins(Diagnostic& diagnostic);

}  // namespace gobo
