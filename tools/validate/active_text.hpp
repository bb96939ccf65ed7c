// The lines of a stage that may be compiled, as tokens.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compose/composition.hpp"
#include "compose/conditions.hpp"

namespace gobo {

/// A token that is compiled, before macros are replaced.
struct Token {
    std::string_view text;
    const Piece* piece;
    int line;
    bool is_name;   ///< or a word of the language
    bool is_noted;  ///< as is_noted() says
};

/// A line that begins with `#` and is read: "define" and "X 1".
struct ActiveDirective {
    std::string_view word;
    std::string_view rest;
    const Piece* piece;
    int line;
};

/// A piece as all stages that have it read it.
struct ReadPiece {
    std::vector<Token> tokens;
    std::vector<ActiveDirective> directives;
    std::vector<std::size_t> tokens_before;  ///< each of the directives
    std::string without_comments;            ///< pointed into, where the piece has comments
    bool differs_from_drivers = false;       ///< as differs_from_drivers() says
    bool may_declare_functions = false;      ///< `);` may stand outside of functions
};

/// Pieces but for prologues, each read once. They must outlive it and stay as they are.
class ReadPieces {
  public:
    const ReadPiece& of(const Piece& piece);

  private:
    std::unordered_map<const Piece*, ReadPiece> known_;
};

/// What no condition leaves out of a stage. It points into the pieces and their tokens.
struct ActiveText {
    ActiveText(std::string_view prologue, bool is_shipped) : conditions(prologue, is_shipped) {}

    /// The text of a token; empty beyond the last.
    [[nodiscard]] std::string_view at(std::size_t index) const {
        return index < tokens.size() ? tokens[index].text : std::string_view();
    }
    [[nodiscard]] bool is_name(std::size_t index) const {
        return index < tokens.size() && tokens[index].is_name;
    }
    [[nodiscard]] bool is_macro(std::size_t index) const { return conditions.is_defined(at(index)) != 0; }

    std::vector<Token> tokens;
    std::vector<ActiveDirective> directives;
    std::vector<std::size_t> tokens_before;  ///< each of the directives
    Conditions conditions;                   ///< at the end of the last piece
};

/// That of a stage, without its first piece, the prologue. Where drivers get the text, the macros that they
/// do not define are not defined.
[[nodiscard]] ActiveText active_text(const std::vector<const Piece*>& pieces, Dialect dialect,
                                     ReadPieces& read);

}  // namespace gobo
