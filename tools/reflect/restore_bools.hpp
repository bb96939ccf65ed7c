// Booleans in blocks, which SPIR-V stores as unsigned integers.
#pragma once

#include <map>
#include <string>

#include "reflect/interface.hpp"

namespace gobo {

/// OpenGL's type enumerants (0x8B56 is GL_BOOL) by flattened name, as glslang's reflection and OpenGL's
/// program-interface queries list them: "Fog.enabled" or, for a block without instance, "enabled";
/// "Lights.lights[0].on". glslang lists unread members only with EShReflectionAllBlockVariables, unread
/// blocks only with EShReflectionSharedStd140UBO. Array subscripts are ignored: all elements have one type.
using GlTypes = std::map<std::string, int>;

/// Whether a block has an unsigned integer, which may have been a boolean: only then are GlTypes worth
/// collecting.
[[nodiscard]] bool may_hold_bools(const Interface& interface);

/// The interface with "uint" and "uvecN" in blocks turned back into "bool" and "bvecN" where `types` says so.
[[nodiscard]] Interface restore_bools(Interface interface, const GlTypes& types);

}  // namespace gobo
