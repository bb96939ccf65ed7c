// A page of pictures: every permutation of a selection, drawn and evaluated, with its error and its cost.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/file_system.hpp"
#include "lab/gallery/picture.hpp"

namespace gobo::gallery {

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

struct GalleryOptions {
    std::string folder;
    study::Weights weights;
    Backend backend = Backend::osmesa;
    int jobs = 1;  ///< threads, each with a context of its own: drivers compile long shaders for seconds
};

/// Writes index.html, and beside it three PNG files for each key, named after it: drawn, expected, and how
/// they differ. `validated` must hold the SPIR-V of every stage; `shipped` holds the page's template. The
/// files named are the page, then the picture of each key that could be drawn.
[[nodiscard]] RenderedSelection make_gallery(const Scene& scene, const Family& family,
                                             const Composition& composition, const Validated& validated,
                                             const GalleryOptions& options, FileSystem& files,
                                             const FileSystem& shipped);

}  // namespace gobo::gallery
