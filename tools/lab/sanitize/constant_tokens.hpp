// The tokens of GLSL, as far as reading constant expressions needs them.
#pragma once

#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "lab/sanitize/constant_value.hpp"

namespace gobo::sanitize {

struct Token {
    std::string_view text;
    int line = 0;

    [[nodiscard]] bool is_name() const { return !text.empty() && is_identifier_start(text.front()); }
};

/// All but the lines that are directives. Refers to the source.
[[nodiscard]] std::vector<Token> lines_as_tokens(std::string_view source);

/// Whether a number begins so.
[[nodiscard]] bool is_number(std::string_view text);

/// The number's value; nothing for a double.
[[nodiscard]] Constant literal(std::string_view text);

}  // namespace gobo::sanitize
