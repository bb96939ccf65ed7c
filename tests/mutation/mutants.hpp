// Mutants of a piece: copies in which one operator or one constant is another.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gobo {

/// One changed piece.
struct Mutant {
    std::string piece;         ///< include path
    int line = 0;              ///< from 1
    std::string change;        ///< "+ to -"
    std::string text;          ///< of the whole piece
    std::string mutated_line;  ///< trimmed, without its comment
};

/// Each arithmetic and comparison operator becomes its opposite, each number half as large again (0 becomes
/// 1), min() becomes max() and back, one at a time. Comments, preprocessor lines, the numbers of bindings and
/// locations are left alone.
[[nodiscard]] std::vector<Mutant> mutants_of(const std::string& piece, std::string_view text);

}  // namespace gobo
