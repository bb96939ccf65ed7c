// Adding to the end of a file on disk: what is there stays, whatever happens.
#pragma once

#include <string>
#include <string_view>

#include "core/diagnostic.hpp"

namespace gobo {

/// Adds `content` to the end of the file, making it and its folder. Fault::file where it cannot be written.
[[nodiscard]] Result<void> append_to_disk(const std::string& path, std::string_view content);

}  // namespace gobo
