// The tokens of GLSL and of its preprocessor.
#pragma once

#include <string_view>
#include <vector>

namespace gobo {

/// The tokens of code without comments: identifiers, numbers, operators (`&&` is one) and other characters.
/// They point into `code`.
[[nodiscard]] std::vector<std::string_view> tokens_of(std::string_view code);

/// Takes the first of these off `code`; empty where there is none left.
[[nodiscard]] std::string_view next_token(std::string_view& code);

}  // namespace gobo
