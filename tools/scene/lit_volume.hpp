// The space that a spot light can light, and how far a box is from it.
#pragma once

#include <glm/vec3.hpp>

#include "scene/box.hpp"

namespace gobo::scene {

/// A solid cone cut off by a ball about its apex. The half angle is in radians, from 0 to pi / 2; the radius
/// may be infinite.
struct LitVolume {
    glm::dvec3 apex{0};
    glm::dvec3 axis{0, 0, -1};  ///< unit vector
    double half_angle = 0;
    double radius = 0;

    /// The point of the volume nearest to `point`.
    [[nodiscard]] glm::dvec3 nearest_to(const glm::dvec3& point) const;
};

/// A distance that is proven to lie between the volume and the box; 0 where none could be proven, which is so
/// wherever they touch. Never more than the true distance.
///
/// Both are convex: points are projected from one onto the other and back (Cheney and Goldstein: Proximity
/// maps for convex sets, Proc. AMS 10, 1959). Each step offers a plane between them; the best one is the
/// proof.
[[nodiscard]] double proven_gap(const LitVolume& volume, const Box& box);

}  // namespace gobo::scene
