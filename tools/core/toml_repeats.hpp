// Keys that a TOML text states twice.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gobo {

/// "the key 'tint' stands twice" where that is what the TOML library complains about, at that line and
/// column, from 1; else nothing. The library's own words garble quoted and dotted keys, so the text is asked.
[[nodiscard]] std::optional<std::string> repeated_key(std::string_view description, std::string_view text,
                                                      std::size_t line, std::size_t column);

}  // namespace gobo
