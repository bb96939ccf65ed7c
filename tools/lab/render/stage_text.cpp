#include "lab/render/stage_text.hpp"

namespace gobo {

StageText stage_text(const Composition& composition, int stage) {
    const Stage& source = composition.stages[static_cast<std::size_t>(stage)];
    StageText text{source.kind, {}};
    for (const int piece : source.pieces)
        text.pieces.push_back(composition.pieces[static_cast<std::size_t>(piece)]);
    return text;
}

StageText stage_text(StageKind kind, const std::string& name, const std::string& text) {
    return {kind, {Piece{name, name, text, false}}};
}

}  // namespace gobo
