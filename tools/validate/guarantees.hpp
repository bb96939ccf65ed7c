// What every driver of a dialect offers, as messages say it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "compose/composition.hpp"

namespace gobo {

/// What every driver of the dialect offers where gobo takes up to `limit`, which OpenGL guarantees: less for
/// some of Vulkan's limits.
[[nodiscard]] std::int64_t guaranteed(Dialect dialect, std::int64_t limit, std::string_view constant);

/// Why `size` is too much: "OpenGL guarantees only 16 (MAX_VERTEX_ATTRIBS)"; for Vulkan by its own name and
/// number of that constant, and what gobo takes where that is more.
[[nodiscard]] std::string guarantee_text(Dialect dialect, std::int64_t size, std::int64_t limit,
                                         std::string_view constant);

}  // namespace gobo
