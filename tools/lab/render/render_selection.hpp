// Pictures of every permutation of a selection, as files.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/bytes.hpp"
#include "core/file_system.hpp"
#include "lab/render/render.hpp"

namespace gobo {

/// What all keys of a selection are drawn with. What is referred to outlives whoever draws them.
struct DrawnSelection {
    const Family& family;
    const Composition& composition;
    const std::vector<Interface>& interfaces;  ///< one per permutation
    const std::vector<Object>& objects;
    const View& view;
};

/// Draws the permutations of a selection, by their number, with the shadow maps that their keys have.
class KeyRenderer {
  public:
    KeyRenderer() = default;
    KeyRenderer(const KeyRenderer&) = delete;
    KeyRenderer& operator=(const KeyRenderer&) = delete;
    virtual ~KeyRenderer() = default;
    /// The renderer with its version.
    [[nodiscard]] virtual std::string name() const = 0;
    [[nodiscard]] virtual Result<Picture> draw(std::size_t permutation) = 0;
};

/// By OpenGL. Samplers that `textures` name get those; without a `pass` nothing is in shadow.
[[nodiscard]] std::unique_ptr<KeyRenderer> opengl_renderer(const Context& context,
                                                           const DrawnSelection& selection,
                                                           const GivenTextures& textures = {},
                                                           const DepthPass* pass = nullptr);

/// Where and how pictures are written.
struct PictureFiles {
    std::string folder;
    ImageFormat format = ImageFormat::png;
    int smooth = 1;  ///< pixels are averages of so many, squared: the view is that much larger
};

/// A picture as a file, what drew it, and what there was to say of it.
struct PictureFile {
    std::string bytes;
    std::string renderer;
    Diagnostics warnings;
};
GOBO_FIELDS(PictureFile, bytes, renderer, warnings)
[[nodiscard]] Result<PictureFile> picture_file(Picture picture, const PictureFiles& pictures,
                                               const std::string& renderer);

/// What a driver did not survive.
struct DriverDeath {
    std::size_t permutation = 0;
    Diagnostics errors;  ///< how it ended
};

/// The files written, in the order of the permutations, and what there was to say, once for all keys that
/// share it. A permutation that fails writes no file and stops no other.
struct RenderedSelection {
    std::vector<std::string> files = {};
    Diagnostics diagnostics = {};
    std::string renderer = {};
    std::vector<DriverDeath> deaths = {};
};

/// Has each permutation drawn by what `open` gives, in `jobs` child processes (see ask_driver(), whose errors
/// it has), and writes it to a file named after its key. `driver` is the renderer's name in messages.
[[nodiscard]] Result<RenderedSelection> render_selection(
    const std::string& driver, int jobs, const Family& family, const Composition& composition,
    const PictureFiles& pictures, FileSystem& files,
    const std::function<Result<std::unique_ptr<KeyRenderer>>()>& open);

}  // namespace gobo
