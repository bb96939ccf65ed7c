// A porcelain teapot on a chequered floor at night: moonlight, a spot from above, a lamp beside it, mist.
#pragma once

#include <string>

#include "renderer.hpp"

namespace teapot {

class Scene {
  public:
    /// Reads the teapot from an OBJ file.
    explicit Scene(const std::string& teapot_file);

    /// Draws everything with the features of a key; `aspect` is width over height. What glows of itself is
    /// drawn with the same fog and no lights: it pays for none.
    void draw(Renderer& renderer, const lit::Key& key, float aspect) const;

  private:
    Mesh teapot_;
    Mesh light_tiles_;
    Mesh dark_tiles_;
    Mesh lamp_;
};

}  // namespace teapot
