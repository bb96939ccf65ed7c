// A picture of a scene without a renderer: stages evaluated in fp32, between them the rasteriser.
#pragma once

#include "lab/render/image.hpp"
#include "lab/scene_picture/scene_shaders.hpp"
#include "lab/scene_picture/scene_view.hpp"
#include "lab/scene_picture/software_images.hpp"
#include "lab/verify/shade.hpp"

namespace gobo::scene {

/// What the evaluator drew.
struct SoftwarePicture {
    Image color;                    ///< linear, four channels, rows from the top down
    std::vector<int> draw;          ///< which draw each pixel shows, rows from the top down; -1: none
    std::size_t fragments = 0;      ///< shaded
    evaluate::Counts operations{};  ///< that shading them executed, if they were counted
};

/// One program for each permutation.
using SoftwarePrograms = std::vector<verify::SoftwareProgram>;

[[nodiscard]] Result<SoftwarePrograms> software_programs(const SceneShaders& shaders);

/// Draws objects, one for each draw, in the scene's order and with a depth test (less). Only what is seen is
/// shaded. `values` are the family's, an object's own come after them. Samplers read one colour where
/// `images` has nothing for them.
[[nodiscard]] Result<SoftwarePicture> draw_in_software(const SceneShaders& shaders,
                                                       const SoftwarePrograms& programs,
                                                       const std::vector<Object>& objects,
                                                       const std::vector<RenderValue>& values,
                                                       const SceneView& view, bool counts = false,
                                                       const SoftwareImages& images = {});

}  // namespace gobo::scene
