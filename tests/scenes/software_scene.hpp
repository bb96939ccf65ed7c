// A picture of a scene without a renderer: stages evaluated in fp32, between them the rasteriser; images are
// alpha maps, pictures and cube maps as they are and shadow maps rasterised in double precision.
#pragma once

#include <functional>
#include <memory>

#include "lab/evaluate/images.hpp"
#include "lab/raster/shade.hpp"
#include "lab/render/image.hpp"
#include "lab/scene_picture/draw_scene.hpp"

namespace gobo::scene {

struct SoftwareImages {
    SceneImages images;
    std::vector<Object> casters;                        ///< shadow cameras are fitted to them
    int side = 0;                                       ///< texels along each side of a shadow map
    std::shared_ptr<const evaluate::DepthTexels> maps;  ///< null: no draw receives shadows
    /// The values of a draw's shadows under the names that its shader has for them; none: those of `lit`.
    std::function<std::vector<RenderValue>(std::size_t draw, const std::vector<RenderValue>& shadows)>
        renamed = nullptr;
    evaluate::Images cubes = {};  ///< of the environment
    /// Gives a draw's fragments other colours than the evaluator's.
    std::function<Result<void>(std::size_t draw, const raster::RasterObject& object,
                               std::vector<raster::Shaded>& shaded)>
        recolored = nullptr;
};

/// Draws the shadow maps of all lights that `images` names, as the depth pass of a renderer does. What a map
/// shows is moved away from the light by `slope` times its depth's largest slope over a texel.
[[nodiscard]] SoftwareImages software_images(SceneImages images, const std::vector<Object>& casters,
                                             int side = 256, double slope = 2);

/// The image of a sampler2D whose alpha is the map's, other components 1: filtered linearly, repeated.
[[nodiscard]] evaluate::Image alpha_image(const AlphaMap& map);

/// What the evaluator drew.
struct SoftwarePicture {
    Image color;                    ///< linear, four channels, rows from the top down
    std::vector<int> draw;          ///< which draw each pixel shows, rows from the top down; -1: none
    std::size_t fragments = 0;      ///< shaded
    evaluate::Counts operations{};  ///< that shading them executed, if they were counted
};

/// One program for each permutation.
using SoftwarePrograms = std::vector<raster::Pipeline>;

[[nodiscard]] Result<SoftwarePrograms> software_programs(const SceneShaders& shaders);

/// Draws objects, one for each draw, in the order of drawing_order() and with a depth test (less). Only what
/// is seen is shaded. `values` are the family's, an object's own come after them. Samplers read one colour
/// where `images` has nothing for them.
[[nodiscard]] Result<SoftwarePicture> draw_in_software(const SceneShaders& shaders,
                                                       const SoftwarePrograms& programs,
                                                       const std::vector<Object>& objects,
                                                       const std::vector<RenderValue>& values,
                                                       const SceneView& view, bool counts = false,
                                                       const SoftwareImages& images = {});

}  // namespace gobo::scene
