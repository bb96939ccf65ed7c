// A permutation drawn by the renderer, with all that the same picture can be evaluated from without one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/render/render.hpp"
#include "lab/render/shadow_maps.hpp"

namespace gobo::gallery {

/// What all permutations are shown in.
struct Scene {
    std::vector<Object> objects;
    View view;
    DepthPass depth_pass;  ///< draws the maps of keys with shadows; no stages: there are none
    std::map<std::string, Image> cube_maps;  ///< of samplers, as CubeMaps::add() takes them
};

/// From a little above, so that the ground fills the picture.
[[nodiscard]] Camera gallery_camera();

struct Drawing {
    Image color;                      ///< linear radiance
    std::vector<RenderValue> values;  ///< of the uniforms, those of the shadow maps among them
    evaluate::Images images;          ///< what the samplers answer, texel for texel
    Diagnostics warnings;
};

/// Draws with textures of one level, whose filtering is exact in floats. Errors as of render_permutation().
[[nodiscard]] Result<Drawing> draw(const Context& context, const Scene& scene, const Family& family,
                                   const Composition& composition, const Permutation& permutation,
                                   const Interface& interface);

}  // namespace gobo::gallery
