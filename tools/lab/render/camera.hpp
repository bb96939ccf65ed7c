// Cameras and matrices, in double precision. Right-handed; eye space looks along -z; clip space is OpenGL's.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gobo {

/// A perspective camera. Lengths are in the scene's unit.
struct Camera {
    glm::dvec3 position{0, 0, 5};
    glm::dvec3 target{0, 0, 0};
    glm::dvec3 up{0, 1, 0};
    double field_of_view = 0.7;  ///< vertical, radians, in (0, pi)
    double near_plane = 0.1;     ///< above 0
    double far_plane = 100;

    /// World to eye space.
    [[nodiscard]] glm::dmat4 view() const;
    /// Eye to clip space; `aspect` is width over height.
    [[nodiscard]] glm::dmat4 projection(double aspect) const;
};

/// From OpenGL's clip space to Vulkan's: depth 0 to 1, y downward. A projection behind this draws upright
/// pictures whose triangles run as OpenGL's do.
[[nodiscard]] glm::dmat4 vulkan_clip_space_of_pictures();
/// The same with y upward: what texture coordinates of 0 to 1 then find in a shadow map is what OpenGL's
/// find.
[[nodiscard]] glm::dmat4 vulkan_clip_space_of_maps();

/// Transforms normals where `matrix` transforms points: the inverse transpose of its upper left 3 x 3,
/// computed from cofactors. Where that has no inverse, or one beyond float's range (a scene flattened or
/// scaled by 1e-20), the cofactors are scaled so that the largest is 1: the directions stay right, and
/// shaders normalise.
[[nodiscard]] glm::dmat3 normal_matrix(const glm::dmat4& matrix);

}  // namespace gobo
