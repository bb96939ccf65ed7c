// Every permutation of a composition drawn, evaluated, and put on one page.
#pragma once

#include <string>
#include <vector>

#include "core/file_system.hpp"
#include "lab/gallery/drawing.hpp"
#include "lab/study/weights.hpp"
#include "validate/validate.hpp"

namespace gobo::gallery {

struct GalleryOptions {
    std::string folder;
    study::Weights weights;
    Backend backend = Backend::osmesa;
    int jobs = 1;  ///< threads, each with a context of its own: drivers compile long shaders for seconds
};

/// The files written: the page, then the picture of each key that could be drawn. A permutation that fails
/// stops no other; what there was to say is told once for all keys that share it.
struct MadeGallery {
    std::vector<std::string> files;
    Diagnostics diagnostics;
};

/// Writes index.html, and beside it three PNG files for each key, named after it: drawn, expected, and how
/// they differ. `validated` must hold the SPIR-V of every stage; `shipped` holds the page's template.
[[nodiscard]] MadeGallery make_gallery(const Scene& scene, const Family& family,
                                       const Composition& composition, const Validated& validated,
                                       const GalleryOptions& options, FileSystem& files,
                                       const FileSystem& shipped);

}  // namespace gobo::gallery
