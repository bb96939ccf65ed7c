// A driver's compile log, in terms of pieces.
#pragma once

#include <string_view>
#include <vector>

#include "render/stage_text.hpp"

namespace gobo {

/// Line `line` (from 1) of string number `string` (from 0) as a driver counts them. Mesa counts lines over
/// all strings of glShaderSource put together and calls the string 0; others number the strings: both are
/// understood.
[[nodiscard]] Place place_in_pieces(const std::vector<Piece>& pieces, int string, int line);

/// Every message of the log as a diagnostic at its piece and that piece's own line, with the quoted line.
/// Understood: Mesa `0:12(5): error: text`, NVIDIA `0(12) : error C1: text`, AMD and Intel `ERROR: 0:12:
/// text`. Other lines become diagnostics without a place; empty lines are left out.
[[nodiscard]] Diagnostics diagnostics_of_log(std::string_view log, const StageText& stage);

}  // namespace gobo
