#include "compose/composition.hpp"

namespace gobo {

std::string_view name_of(StageKind kind) {
    return kind == StageKind::vertex ? "vertex" : "fragment";
}

std::string_view line_of(const Piece& piece, int number) {
    return line_of(piece.file_text.empty() ? piece.text : piece.file_text, number);
}

std::string source_of(const Composition& composition, const Stage& stage) {
    std::string source;
    for (const int piece : stage.pieces) source += composition.pieces[static_cast<std::size_t>(piece)].text;
    return source;
}

}  // namespace gobo
