// layout(depth_greater) and its like before GLSL 4.20: GL_ARB_conservative_depth brings them, which glslang
// does not know. It gets the text without them, and the SPIR-V that it makes states them again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "validate/active_text.hpp"
#include "validate/validate.hpp"

namespace gobo {

/// Whether the prologue of a stage states the extension, and a version that lacks the layouts.
[[nodiscard]] bool takes_depth_layouts(std::string_view prologue);

/// The text with blanks for `layout(depth_less) out float gl_FragDepth;`.
[[nodiscard]] std::string without_depth_layouts(std::string text);

/// The execution mode that such a declaration asks for.
[[nodiscard]] std::optional<std::uint32_t> depth_mode(const ActiveText& text);

/// The module of a fragment stage with that mode of its only entry point.
[[nodiscard]] SpirvModule with_depth_mode(SpirvModule module, std::uint32_t mode);

}  // namespace gobo
