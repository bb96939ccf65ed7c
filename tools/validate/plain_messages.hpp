// glslang's messages with what they leave out: the places that those of linking mean, macros that are the
// cause.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "validate/active_text.hpp"

namespace gobo {

using PieceList = std::vector<const Piece*>;

/// Of a fragment stage that writes both gl_FragColor and gl_FragData (GLSL 1.20, 7.2), at the latter.
[[nodiscard]] Diagnostic color_and_data_message(const PieceList& pieces);

/// For messages of linking. `pieces` are those of the stage, or of the later of two; `earlier` those of the
/// other, if any.
[[nodiscard]] Diagnostics with_places(Diagnostics found, const PieceList& pieces,
                                      const PieceList& earlier = {});

/// For messages of parsing: names the macro of another line where a line does not read as it is written,
/// and the dialect that takes what is Vulkan's alone. `directives` are those of the stage.
[[nodiscard]] Diagnostics with_macros(Diagnostics found, const std::vector<ActiveDirective>& directives);

}  // namespace gobo
