// Which names C++ code had better not use.
#pragma once

#include <string_view>

namespace gobo {

/// Whether the name is a keyword of C++ (20 too) or a macro of the standard library, <windows.h> or
/// <X11/Xlib.h>.
[[nodiscard]] bool is_reserved_name(std::string_view name);

/// Whether C++'s standard headers declare the name at global scope, as a function or a struct (`log`, `main`,
/// `tm`), or a generated header needs it there (`std`, `glm`, `gobo`): no namespace can have it.
[[nodiscard]] bool is_global_name(std::string_view name);

}  // namespace gobo
