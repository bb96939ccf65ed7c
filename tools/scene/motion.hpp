// Where things are in the world, at any time: boxes that hold them through every animation.
#pragma once

#include <optional>

#include "scene/scene.hpp"

namespace gobo::scene {

/// Whether an animation moves the node, or one above it.
[[nodiscard]] bool is_moving(const Scene& scene, int node);

/// A box of world space that holds what lies in `box` of the node's space, whatever time the animations are
/// at, each by itself or together. Exact for a node at rest whose transform keeps axes parallel; otherwise it
/// may be larger.
[[nodiscard]] Box world_box(const Scene& scene, int node, const Box& box);

/// The world box of a primitive of a node's mesh: skin, morph targets and animations included. Nothing where
/// it cannot be told: the node has a skin, but a vertex no weights.
[[nodiscard]] std::optional<Box> world_bounds(const Scene& scene, int node, const Primitive& primitive);

}  // namespace gobo::scene
