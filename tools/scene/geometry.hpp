// Boxes and the space that a spot light lights, in double precision, and where the nodes of a scene may be at
// any time: interval arithmetic bounds what moves.
#pragma once

#include "scene/scene.hpp"

namespace gobo::scene {

[[nodiscard]] glm::dvec3 unit_or_zero(const glm::dvec3& vector);

/// The box of the transformed corners: it contains every transformed point. Affine matrices only.
[[nodiscard]] Box transformed(const glm::dmat4& matrix, const Box& box);

/// The box that holds the componentwise products, or sums, of a point of `a` and one of `b`.
[[nodiscard]] Box product(const Box& a, const Box& b);
[[nodiscard]] Box sum(const Box& a, const Box& b);

/// Of the box along a direction: least and greatest dot product with it.
[[nodiscard]] Interval extent_of(const Box& box, const glm::dvec3& direction);

/// Least and greatest distance between a point of `a` and one of `b`; neither may be empty.
[[nodiscard]] double least_distance(const Box& a, const Box& b);
[[nodiscard]] double greatest_distance(const Box& a, const Box& b);

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

/// Whether an animation moves the node, or one above it.
[[nodiscard]] bool is_moving(const Scene& scene, std::size_t node);

/// A box of world space that holds what lies in `box` of the node's space, whatever time the animations are
/// at, each by itself or together. Exact for a node at rest whose transform keeps axes parallel; otherwise it
/// may be larger.
[[nodiscard]] Box world_box(const Scene& scene, std::size_t node, const Box& box);

/// The world box of a primitive of a node's mesh: skin, morph targets and animations included. Nothing where
/// it cannot be told: the node has a skin, but a vertex no weights.
[[nodiscard]] std::optional<Box> world_bounds(const Scene& scene, std::size_t node,
                                              const Primitive& primitive);

}  // namespace gobo::scene
