// The versions that GLSL has.
#pragma once

#include <string_view>

namespace gobo {

/// Whether the text may stand behind #version: "330 core", "450", "300 es".
[[nodiscard]] bool is_glsl_version(std::string_view text);

}  // namespace gobo
