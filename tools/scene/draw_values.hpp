// What a scene says of the uniforms of its draws.
#pragma once

#include <vector>

#include "family/family.hpp"
#include "scene/effects.hpp"

namespace gobo::scene {

/// By their names in `lit` and `pbr`: the material, the light around, fog, tones, holes, and the lights that
/// are in. Lights of a kind stand in the scene's order, those whose shadows are in first, from element 0 on.
/// Places and directions are of world space, with the source that brings them into eye space.
[[nodiscard]] std::vector<RenderValue> values_of_draw(const Scene& scene, const Draw& draw);

[[nodiscard]] bool receives_shadow(const Draw& draw, const PlacedLight& light);

/// The lights that are in, by their number among those of the scene, in the order of the draw's blocks: those
/// whose shadows are in come first.
[[nodiscard]] std::vector<std::size_t> lights_in_order(const Draw& draw,
                                                       const std::vector<PlacedLight>& lights);

}  // namespace gobo::scene
