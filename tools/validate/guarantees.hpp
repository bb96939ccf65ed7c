// What every driver of a dialect offers, as messages say it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "compose/composition.hpp"

namespace gobo {

/// "OpenGL guarantees only 16 (MAX_VERTEX_ATTRIBS)"; for Vulkan by its own name and number of that constant.
[[nodiscard]] std::string guarantee_text(Dialect dialect, std::int64_t limit, std::string_view constant);

}  // namespace gobo
