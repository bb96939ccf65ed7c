// What only glslang's syntax tree says of a stage: SPIR-V holds no precision but in OpenGL ES from 3.10 on,
// and no function that main() does not reach.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <glslang/Public/ShaderLang.h>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// "highp", "mediump" or "lowp" by the name of a uniform, "lamps.color" of a member, without indices.
using Precisions = std::map<std::string, std::string, std::less<>>;

/// Those of uniforms outside blocks, stated or by default. The shader must have been parsed as OpenGL ES.
[[nodiscard]] Precisions precisions_of(const glslang::TShader& shader);

/// Puts the precisions into uniforms, their members and samplers.
void set_precisions(Interface& interface, const Precisions& precisions);

/// Functions without a body that another one calls, even where main() never comes there: drivers refuse to
/// link it, glslang only looks at what main() reaches. The shader must have been parsed and not been linked.
[[nodiscard]] Diagnostics check_calls(const glslang::TShader& shader,
                                      const std::vector<const Piece*>& pieces);

}  // namespace gobo
