// One permutation drawn by the renderer, and the same picture evaluated without one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "lab/raster/compare_picture.hpp"
#include "lab/render/render.hpp"
#include "lab/study/weights.hpp"
#include "validate/validate.hpp"

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

/// A drawn permutation, with all that the same picture can be evaluated from without a renderer.
struct Drawing {
    Interface interface;
    Image color;                      ///< linear radiance
    std::vector<RenderValue> values;  ///< of the uniforms, those of the shadow maps among them
    evaluate::Images images;          ///< what the samplers answer, texel for texel
    Diagnostics warnings;
};

/// Draws with textures of one level, whose filtering is exact in floats. Errors as of render_permutation().
[[nodiscard]] Result<Drawing> draw(const Context& context, const Scene& scene, const Family& family,
                                   const Composition& composition, const Validated& validated,
                                   const Permutation& permutation);

struct Evaluation {
    raster::PictureReport report;  ///< how far the drawing is from it, with its pictures
    double fragment_cost = 0;      ///< of a fragment on average, in the weights' unit
    double vertex_cost = 0;        ///< of a vertex
};

/// Evaluates the stages in fp32 for every pixel of the drawing; `validated` holds their SPIR-V. Errors of
/// decoding and of the scene's values.
[[nodiscard]] Result<Evaluation> evaluate_drawing(const Drawing& drawing, const Scene& scene,
                                                  const Validated& validated, const Permutation& permutation,
                                                  const study::Weights& weights);

/// The factor that brings all but the brightest hundredth of the picture's pixels below a display's white,
/// since many lights together are brighter than that; 1 for a picture that is darker.
[[nodiscard]] float exposure_of(const Image& picture);
/// The picture's colours times `exposure`; a fourth channel stays.
[[nodiscard]] Image exposed(Image picture, float exposure);

}  // namespace gobo::gallery
