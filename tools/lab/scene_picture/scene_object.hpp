// A draw of a scene as the renderer takes it: its mesh, where it stands, and what its uniforms hold.
#pragma once

#include <vector>

#include "family/family.hpp"
#include "lab/render/draw_list.hpp"
#include "scene/effects.hpp"
#include "scene/light_reach.hpp"

namespace gobo::scene {

/// The lights that are in, by their number among those of the scene, in the order of the draw's blocks: those
/// whose shadows are in come first.
[[nodiscard]] std::vector<std::size_t> lights_in_order(const Draw& draw,
                                                       const std::vector<PlacedLight>& lights);

/// The draw's uniforms and attributes by their names in `lit`, in world space: the material, the light
/// around, fog, tones, holes, and the lights that are in. Lights of a kind stand in their order, from element
/// 0 on; those beyond them have no colour, so that a permutation for more lights draws the same. Shadows are
/// not among them: they follow from the view (scene_images.hpp).
[[nodiscard]] std::vector<RenderValue> values_of(const Scene& scene, const Draw& draw);

/// The draw as an object with these values. Back faces are culled unless the material is double-sided.
[[nodiscard]] Object object_of(const Scene& scene, const Draw& draw);

/// A family's values without those of blocks that a scene fills: what a scene does not light is dark, not lit
/// by the family's demonstration.
[[nodiscard]] std::vector<RenderValue> values_beside_scene(const std::vector<RenderValue>& family_values);

}  // namespace gobo::scene
