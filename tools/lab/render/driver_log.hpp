// A driver's compile log, in terms of pieces.
#pragma once

#include <string_view>
#include <vector>

#include "lab/render/stage_text.hpp"

namespace gobo {

/// Every message of the log as a diagnostic at its piece and that piece's own line, with the quoted line.
/// Understood: Mesa `0:12(5): error: text`, NVIDIA `0(12) : error C1: text`, AMD and Intel `ERROR: 0:12:
/// text`. Other lines become diagnostics without a place; empty lines are left out.
[[nodiscard]] Diagnostics diagnostics_of_log(std::string_view log, const StageText& stage);

}  // namespace gobo
