// Six faces of a cube as one picture.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "lab/render/image.hpp"

namespace gobo::probe {

/// The unit vector of a texel's centre on a face of `side` texels: faces +x -x +y -y +z -z, columns along s,
/// rows along t, as OpenGL 4.5 has them in table 8.19. Row 0 is the first that glTexImage2D takes.
[[nodiscard]] glm::dvec3 cube_direction(int face, int side, int column, int row);

/// A picture of side x 6 side texels, the faces one below the other, with what `radiance` gives for each
/// direction. It is called by `jobs` threads.
[[nodiscard]] Image make_cube_map(int side, int jobs,
                                  const std::function<glm::dvec3(const glm::dvec3&)>& radiance);

}  // namespace gobo::probe
