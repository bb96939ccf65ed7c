// What glslang says, as diagnostics at the pieces.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

/// glslang's error of a member that states an offset to which its type is not aligned, with both numbers.
[[nodiscard]] std::string unaligned_text(std::string_view offset, std::string_view type);
/// What is said of a shader's own constant that has the constant_id of a count.
[[nodiscard]] std::string id_of_count(int id, std::string_view count);
inline constexpr std::string_view kIdsOfCounts =
    "the first constant_ids, from 0, are those of the counts with specialize = true: give yours a number "
    "behind them";

/// Reads the lines of an info log. A message that names one of the pieces gets that piece's path and line,
/// with the line quoted; the rest (those of linking) stand at `otherwise`. Of what follows from another
/// message nothing is said, unless `all`.
[[nodiscard]] Diagnostics diagnostics_of_log(std::string_view log, const std::vector<const Piece*>& pieces,
                                             const Place& otherwise, bool all = false);

/// Makes errors of what glslang only warns of, although the specification refuses it and drivers do.
void make_strict(Diagnostic& diagnostic, std::string_view prologue, bool is_relaxed);

/// Keeps of the errors of one line the first, and further names that are declared nowhere: the others follow
/// from it.
void drop_consequences(Diagnostics& diagnostics);

/// Of what glslang is known to crash on, tells the place: a case label that is a specialisation constant.
void explain_crash(Diagnostic& error, const std::vector<const Piece*>& pieces);

}  // namespace gobo
