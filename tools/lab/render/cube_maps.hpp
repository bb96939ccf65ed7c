// Cube maps as textures, for pictures lit by an environment.
#pragma once

#include <vector>

#include "lab/render/draw_list.hpp"
#include "lab/render/image.hpp"

namespace gobo {

/// Textures made from pictures, deleted together.
class CubeMaps {
  public:
    explicit CubeMaps(const Context& context) : resources_(context) {}

    /// A picture of side x 6 side texels, the faces +x -x +y -y +z -z one below the other, as the texture of
    /// a samplerCube of that name; its alpha is 1. Fault::input where the picture has another shape.
    [[nodiscard]] Result<void> add(const std::string& sampler, const Image& faces);
    [[nodiscard]] const GivenTextures& textures() const { return textures_; }

  private:
    GlResources resources_;
    GivenTextures textures_;
};

}  // namespace gobo
