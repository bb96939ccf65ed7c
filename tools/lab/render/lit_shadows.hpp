// The lights of `lit` that cast shadows in a permutation, as the family's [render] table places them.
#pragma once

#include <vector>

#include "family/family.hpp"
#include "lab/render/shadow_camera.hpp"

namespace gobo {

/// The first lights of each kind, as many as the features directional_shadows, spot_shadows and point_shadows
/// count, in this order: that of the block `Shadows`. Empty for families without these features.
[[nodiscard]] std::vector<ShadowLight> shadow_lights(const Family& family, const Key& key);

}  // namespace gobo
