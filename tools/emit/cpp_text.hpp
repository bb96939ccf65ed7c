// Pieces of C++ text that every part of the generated header needs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gobo {

/// `text` as a C++ string literal, whatever its bytes: a raw one where it holds a line end and nothing but
/// printable ASCII, tabs and line ends, otherwise one with escapes.
[[nodiscard]] std::string cpp_literal(std::string_view text);

/// The items within braces, some to a line; nothing where there are none (std::array of 0 takes no inner
/// braces).
[[nodiscard]] std::string cpp_list(const std::vector<std::string>& items);

/// `text` cut into parts whose literals stay below the 16,380 bytes that all compilers take, at line ends
/// where possible. At least one part.
[[nodiscard]] std::vector<std::string_view> cut_for_literals(std::string_view text);

}  // namespace gobo
