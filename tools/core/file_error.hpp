// What the system says of files, as messages.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"

namespace gobo {

/// "cannot be ACTION: ..." with the meaning of errno, at the path. Fault::file.
[[nodiscard]] tl::unexpected<Diagnostics> file_error(const std::string& path, std::string_view action,
                                                     int error);

/// Whether one of the errors is that no more files may be open.
[[nodiscard]] bool are_of_descriptors(const Diagnostics& errors);

/// 0, or errno: some file systems report a full disk only as the file is closed. Of a null file errno.
[[nodiscard]] int write_and_close(std::FILE* file, std::string_view content);

}  // namespace gobo
