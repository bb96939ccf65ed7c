// A camera that circles the scene.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace viewer {

struct Orbit {
    glm::dvec3 center{0};
    double radius = 1;     ///< of the sphere that is to be seen
    double angle = 0;      ///< about the vertical axis, radians; 0: from +z
    double height = 0.35;  ///< above the horizon, radians

    /// World to eye space.
    [[nodiscard]] glm::dmat4 view() const;
    /// Eye to clip space; `aspect` is width over height.
    [[nodiscard]] glm::dmat4 projection(double aspect) const;

  private:
    [[nodiscard]] double distance() const;
};

}  // namespace viewer
