// The varyings of a family: which of them a key has, where they stand, and the text that declares them.
#pragma once

#include <vector>

#include "compose/piece_library.hpp"

namespace gobo {

/// Indices of the varyings that some piece of the fragment stage mentions.
[[nodiscard]] std::vector<int> varyings_read(const Family& family, const PieceLibrary& library,
                                             const std::vector<int>& fragment);

/// The declarations of varyings, each on the line of the family file where it stands, so that a
/// diagnostic and the module's debug lines name that place; in the vertex stage also the functions that
/// write them.
[[nodiscard]] Piece varyings_piece(const Family& family, const std::vector<int>& varyings, const Key& key,
                                   StageKind stage);

}  // namespace gobo
