// The images of a scene for the evaluator: alpha maps as they are, shadow maps rasterised in double
// precision.
#pragma once

#include <functional>
#include <memory>

#include "lab/evaluate/evaluate.hpp"
#include "lab/evaluate/images.hpp"
#include "lab/render/draw_list.hpp"
#include "lab/scene_picture/scene_images.hpp"

namespace gobo::scene {

struct SoftwareImages {
    SceneImages images;
    std::vector<Object> casters;                        ///< shadow cameras are fitted to them
    int side = 0;                                       ///< texels along each side of a shadow map
    std::shared_ptr<const evaluate::DepthTexels> maps;  ///< null: no draw receives shadows
    /// The values of a draw's shadows under the names that its shader has for them; none: those of `lit`.
    std::function<std::vector<RenderValue>(std::size_t draw, const std::vector<RenderValue>& shadows)>
        renamed = nullptr;
};

/// Draws the shadow maps of all lights that `images` names, as the depth pass of a renderer does. What a map
/// shows is moved away from the light by `slope` times its depth's largest slope over a texel.
[[nodiscard]] SoftwareImages software_images(SceneImages images, const std::vector<Object>& casters,
                                             int side = 256, double slope = 2);

/// The image of a sampler2D whose alpha is the map's, other components 1: filtered linearly, repeated.
[[nodiscard]] evaluate::Image alpha_image(const AlphaMap& map);

}  // namespace gobo::scene
