// Which names C++ code had better not use.
#pragma once

#include <string_view>

namespace gobo {

/// Whether the name is a keyword of C++ (20 too) or a macro of the standard library, <windows.h> or
/// <X11/Xlib.h>.
[[nodiscard]] bool is_reserved_name(std::string_view name);

}  // namespace gobo
