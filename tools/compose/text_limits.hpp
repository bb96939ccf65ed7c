// What a shader's text may hold, so that whoever parses it comes to an end: brackets and expressions, into
// which parsers recurse, and structs and macros that double one another.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compose/scan_piece.hpp"

namespace gobo {

/// Follows tokens. They must outlive it.
class Nesting {
  public:
    /// Takes in the next token. What is wrong where a limit is passed.
    [[nodiscard]] std::optional<std::string> add(std::string_view token);

  private:
    /// What stands between two brackets.
    struct Level {
        bool is_list = false;  ///< its commas part expressions: a call, an initialiser
        int operators = 0;     ///< of the expression so far
        int elements = 0;      ///< of the list so far
        int statements = 0;    ///< that the one being read stands in, without braces between
        int loops = 0;         ///< of these, `do` whose `while` is to come
        bool is_ended = true;  ///< the statement before is, but for an `else` or the `while` of a `do`
        bool is_label = false;
    };

    void follow_statement(Level& level, std::string_view token);

    std::vector<Level> levels_ = std::vector<Level>(1);
    std::string_view before_ = ";";
};

/// The first macro whose expansion has too many tokens; null where there is none.
[[nodiscard]] const Directive* endless_macro(const std::vector<Directive>& directives);

/// Whether macros that have one another as arguments, in the tokens of a text, expand to too many.
[[nodiscard]] bool has_endless_calls(const std::vector<Directive>& directives,
                                     std::span<const std::string_view> tokens);

/// The name, in `tokens`, of the first struct with too many members, those of its members counted; empty
/// where there is none.
[[nodiscard]] std::string_view endless_struct(std::span<const std::string_view> tokens);

}  // namespace gobo
