// The depth pass of pictures with shadows: the family `depth`, ready to draw.
#pragma once

#include "gobo/command.hpp"
#include "lab/verify/shadow_witness.hpp"

namespace gobo {

/// Whether a key of the composition has shadows to be drawn.
[[nodiscard]] bool has_shadows(const Family& family, const Composition& composition);

/// The default key of the family `depth`, from where families and pieces are found.
[[nodiscard]] Result<DepthPass> load_depth_pass(const World& world, const CommonOptions& options);
/// The same with what evaluates it.
[[nodiscard]] Result<verify::ShadowPass> load_shadow_pass(const World& world, const CommonOptions& options);

}  // namespace gobo
