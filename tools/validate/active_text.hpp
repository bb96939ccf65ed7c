// The lines of a stage that may be compiled, as tokens.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "compose/conditions.hpp"

namespace gobo {

/// A token that is compiled, before macros are replaced.
struct Token {
    std::string_view text;
    const Piece* piece;
    int line;
};

/// A line that begins with `#` and is read: "define" and "X 1".
struct ActiveDirective {
    std::string_view word;
    std::string_view rest;
    const Piece* piece;
    int line;
};

/// What no condition leaves out of a stage. It points into the pieces and into itself.
struct ActiveText {
    ActiveText(std::string_view prologue, bool is_shipped) : conditions(prologue, is_shipped) {}

    /// The text of a token; empty beyond the last.
    [[nodiscard]] std::string_view at(std::size_t index) const {
        return index < tokens.size() ? tokens[index].text : std::string_view();
    }
    [[nodiscard]] bool is_macro(std::size_t index) const { return conditions.is_defined(at(index)) != 0; }

    std::vector<Token> tokens;
    std::vector<ActiveDirective> directives;
    Conditions conditions;                     ///< at the end of the last piece
    std::deque<std::string> without_comments;  ///< texts that are pointed into
};

/// That of a stage, without its first piece, the prologue. Where drivers get the text, the macros that they
/// do not define are not defined.
[[nodiscard]] ActiveText active_text(const std::vector<const Piece*>& pieces, Dialect dialect);

}  // namespace gobo
