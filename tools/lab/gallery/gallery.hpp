// A page of pictures: every permutation of a selection, drawn and evaluated, with its error and its cost.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "core/file_system.hpp"
#include "lab/raster/compare_picture.hpp"
#include "lab/raster/shared_textures.hpp"
#include "lab/render/render_selection.hpp"
#include "lab/study/measure.hpp"
#include "validate/validate.hpp"

namespace gobo::gallery {

/// What all permutations are shown in.
struct Scene {
    std::vector<Object> objects;
    View view;
    DepthPass depth_pass;  ///< draws the maps of keys with shadows; no stages: there are none
    raster::CubeMaps cube_maps;
};

/// From a little above, so that the ground fills the picture.
[[nodiscard]] Camera gallery_camera();

/// A drawn permutation, with all that the same picture can be evaluated from without a renderer.
struct Drawing {
    Interface interface;
    Image color;                      ///< linear radiance
    Image depth;                      ///< as of Picture
    std::vector<RenderValue> values;  ///< of the uniforms, those of the shadow maps among them
    evaluate::Images images;          ///< what the samplers answer, texel for texel
    std::vector<Image> shadow_maps;   ///< their depths, layer by layer
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

/// One permutation. Files are named relative to the page.
struct Entry {
    Key key;
    std::string actual;        ///< drawn by the renderer
    std::string expected;      ///< evaluated in single precision; empty, as the next, where that cannot be
    std::string difference;    ///< of the two
    double largest_error = 0;  ///< over the channels of all pixels but those at an edge; linear radiance
    double root_mean_square = 0;
    std::size_t edges = 0;  ///< pixels that were decided differently at a discontinuity or a triangle's edge
    std::size_t pixels = 0;
    double exposure = 1;       ///< what the colours of the pictures are multiplied by
    double fragment_cost = 0;  ///< of a fragment, on average over those of the picture; in additions
    double vertex_cost = 0;    ///< of a vertex
};
GOBO_FIELDS(Entry, key, actual, expected, difference, largest_error, root_mean_square, edges, pixels,
            exposure, fragment_cost, vertex_cost)

/// What all entries share.
struct Gallery {
    std::string renderer;  ///< GL_RENDERER
    int width = 0;         ///< of each picture, in pixels
    int height = 0;
    double white_error = 0;      ///< the difference that is white in the pictures of errors
    std::string cost_renderer;   ///< on which the costs' unit, one addition of floats, was measured
    std::vector<Entry> entries;  ///< in the order of the keys
};

/// The page: one file without references to others but the pictures beside it. `shipped` holds its template.
[[nodiscard]] Result<std::string> page(const FileSystem& shipped, const Family& family,
                                       const Gallery& gallery);

class LivePage;

struct GalleryOptions {
    std::string folder;
    study::Weights weights;
    std::string driver = "the renderer";  ///< in messages
    Backend backend = Backend::osmesa;
    int jobs = 1;              ///< child processes: drivers compile long shaders for seconds
    LivePage* live = nullptr;  ///< gets each permutation that could be evaluated, and is written as live.html
};

/// Writes index.html, and beside it three PNG files for each key, named after it: drawn, expected, and how
/// they differ. `validated` must hold the SPIR-V of every stage; `shipped` holds the page's template. The
/// files named are the page, then the picture of each key that could be drawn. Errors of ask_driver().
[[nodiscard]] Result<RenderedSelection> make_gallery(const Scene& scene, const Family& family,
                                                     const Composition& composition,
                                                     const Validated& validated,
                                                     const GalleryOptions& options, FileSystem& files,
                                                     const FileSystem& shipped);

}  // namespace gobo::gallery
