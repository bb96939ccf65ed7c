// A camera that circles the scene.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "lab/scene_picture/draw_scene.hpp"
#include "stage.hpp"

namespace viewer {

/// Circles about a vertical axis, starting from a view.
struct Orbit {
    gobo::scene::SceneView start;
    glm::dvec3 center{0};  ///< a point of the axis, in world space
    double angle = 0;      ///< radians, from +z towards +x

    /// World to eye space.
    [[nodiscard]] glm::dmat4 view() const;
};

/// Starts from the scene's first camera and circles the point before it that is nearest to the scene's
/// middle; where the scene has none, circles everything from a little above. The size is that of the
/// pictures, in pixels.
[[nodiscard]] Orbit orbit_of(const Stage& stage, int width, int height);

}  // namespace viewer
