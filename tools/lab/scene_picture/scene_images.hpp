// What the draws of a scene look up in images: the holes of cut surfaces, and shadow maps.
#pragma once

#include <vector>

#include "lab/render/shadow_maps.hpp"
#include "scene/effects.hpp"

namespace gobo::scene {

/// Which images each draw looks up.
struct SceneImages {
    std::vector<AlphaMap> opacity;    ///< one per draw; without texels: opaque all over
    std::vector<ShadowLight> lights;  ///< of which some draw receives shadows, in the scene's order
    /// One list per draw: the lights whose shadows it receives, by number, in the order of lit's block
    /// `Shadows`: directional ones, spots, points.
    std::vector<std::vector<std::size_t>> shadows;
};

[[nodiscard]] SceneImages images_of(const Scene& scene, const std::vector<Draw>& draws);

/// The values of the block `Shadows` for a draw, out of those of a plan for all lights.
[[nodiscard]] std::vector<RenderValue> shadow_values(const ShadowPlan& plan,
                                                     const std::vector<std::size_t>& lights);

}  // namespace gobo::scene
