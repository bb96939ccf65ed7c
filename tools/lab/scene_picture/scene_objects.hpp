// The draws of a scene as the renderer takes them: meshes, where they stand, what their uniforms hold, and
// what they look up in images: the holes of cut surfaces, and shadow maps.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lab/render/draw_list.hpp"
#include "lab/render/shadow_maps.hpp"
#include "scene/effects.hpp"

namespace gobo::scene {

/// The draw as an object, with its uniforms and attributes by their names in `lit`, in world space: the
/// material, the light around, fog, tones, holes, and the lights that are in. Lights of a kind stand in the
/// scene's order, those whose shadows are in first, from element 0 on; the elements beyond them have no
/// colour, so that a permutation for more lights draws the same. Values of shadows follow from the view
/// (shadow_values()). Back faces are culled unless the material is double-sided.
[[nodiscard]] Object object_of(const Scene& scene, const Draw& draw);

/// A family's values without those of blocks that a scene fills: what a scene does not light is dark, not lit
/// by the family's demonstration.
[[nodiscard]] std::vector<RenderValue> values_beside_scene(const std::vector<RenderValue>& family_values);

/// A picture as a sampler looks it up.
struct PictureUse {
    const TextureImage* picture = nullptr;
    const TextureUse* use = nullptr;
    bool is_srgb = false;
};

/// Which images each draw looks up.
struct SceneImages {
    std::vector<AlphaMap> opacity;    ///< one per draw; without texels: opaque all over
    std::vector<ShadowLight> lights;  ///< of which some draw receives shadows, in the scene's order
    /// One list per draw: the lights whose shadows it receives, by number, in the order of lit's block
    /// `Shadows`: directional ones, spots, points.
    std::vector<std::vector<std::size_t>> shadows;
    /// One per draw: the pictures of its metallic-roughness material, by the names of their samplers. They
    /// point into the scene.
    std::vector<std::map<std::string, PictureUse>> pictures = {};
    std::vector<bool> are_blended = {};  ///< one per draw: alphaMode BLEND
};

[[nodiscard]] SceneImages images_of(const Scene& scene, const std::vector<Draw>& draws);

/// The values of the block `Shadows` for a draw, out of those for all lights.
[[nodiscard]] std::vector<RenderValue> shadow_values(const std::vector<RenderValue>& of_all,
                                                     const std::vector<std::size_t>& lights);

}  // namespace gobo::scene
