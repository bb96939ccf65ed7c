// A page that draws permutations in the browser that shows it, by WebGL 2, beside what the interpreter says.
#pragma once

#include <string>
#include <vector>

#include "lab/gallery/gallery.hpp"

namespace gobo::gallery {

/// One file without references to others: the stages in GLSL ES 3.00, meshes, textures, values of uniforms,
/// and the pictures that the interpreter computed.
class LivePage {
  public:
    /// `composition` has the keys of the gallery's in their order, for Dialect::es300; `interfaces` are its
    /// permutations'. All must outlive it.
    LivePage(const Family& family, const Scene& scene, const Composition& composition,
             const std::vector<Interface>& interfaces)
        : family_(family),
          scene_(scene),
          composition_(composition),
          interfaces_(interfaces),
          permutations_(interfaces.size()) {}

    /// Adds a permutation, by its number; of the drawing the values and the shadow maps count.
    /// Errors as of resolve_uniforms(), and for a sampler
    /// that the page has no texture for.
    Result<void> add(std::size_t number, const Drawing& drawing, const Image& expected, float exposure);

    /// The page with what was added. `shipped` holds its template.
    [[nodiscard]] Result<std::string> text(const FileSystem& shipped, double white_error) const;

  private:
    /// The number of what several permutations have, such as a mesh.
    std::size_t shared(std::string data);

    const Family& family_;
    const Scene& scene_;
    const Composition& composition_;
    const std::vector<Interface>& interfaces_;
    std::vector<std::string> permutations_;  ///< JSON; empty where there is none
    std::vector<std::string> shared_;        ///< data URLs, each once
};

}  // namespace gobo::gallery
