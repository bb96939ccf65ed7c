#include "compose/composition.hpp"

namespace gobo {

std::string_view line_of(const Piece& piece, int number) {
    return piece.file_text.empty() ? line_of(piece.text, number - piece.first_line + 1)
                                   : line_of(piece.file_text, number);
}

void put_at(Diagnostic& diagnostic, const Piece& piece, int line) {
    const auto moved = piece.moved_lines.find(line);
    const bool is_moved = moved != piece.moved_lines.end();
    diagnostic.place = is_moved ? moved->second.first : Place{piece.path, line, 0};
    diagnostic.quoted_line = is_moved ? moved->second.second : line_of(piece, line);
}

std::string source_of(const Composition& composition, const Stage& stage) {
    std::string source;
    for (const int piece : stage.pieces) source += composition.piece(piece).text;
    return source;
}
}  // namespace gobo
