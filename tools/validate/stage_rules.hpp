// What glslang lets pass within one stage.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "reflect/interface.hpp"
#include "spirv/usage.hpp"

namespace gobo {

/// Outputs that no path or only some paths through main() write, gl_Position that is never written, and
/// depths and discards that early_fragment_tests makes useless, as warnings; depth_* without its extension
/// is an error, as are more outputs of a geometry stage than are guaranteed. `places_vertices`: what the
/// stage writes to gl_Position is where its vertices are drawn.
[[nodiscard]] Diagnostics check_stage(const spirv::Module& module, const spirv::Usage& usage,
                                      const Interface& interface, const std::vector<const Piece*>& pieces,
                                      bool places_vertices, Dialect dialect);

}  // namespace gobo
