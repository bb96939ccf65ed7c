// Names that C++'s own headers take at global scope.
#pragma once

#include <string_view>

namespace gobo {

/// Functions, types and constants of the standard library and of POSIX beside it, with blanks between.
[[nodiscard]] std::string_view global_names();

}  // namespace gobo
