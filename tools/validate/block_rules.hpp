// What a stage says of its blocks that glslang takes, and drivers refuse or lay out as they like.
#pragma once

#include "compose/dialect.hpp"
#include "core/diagnostic.hpp"
#include "core/stage.hpp"
#include "validate/active_text.hpp"

namespace gobo {

/// Errors of blocks that drivers refuse; where they get the text, also of qualifiers in an order that their
/// parsers do not know, and a warning of each uniform block whose layout is left to them.
[[nodiscard]] Diagnostics check_blocks(StageKind kind, const ActiveText& text, const GlslVersion& version,
                                       bool is_shipped);

}  // namespace gobo
