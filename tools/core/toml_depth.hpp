// Keys of a TOML text that would take a reader of it too deep.
#pragma once

#include <string_view>

namespace gobo {

/// The most parts that a dotted key may have.
inline constexpr int kMostKeyParts = 64;

/// The line where a dotted key has too many parts: each is a table within a table, which TOML libraries take
/// apart by recursion. 0 where none has.
[[nodiscard]] int line_of_overlong_key(std::string_view text);

}  // namespace gobo
