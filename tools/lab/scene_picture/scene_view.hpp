// From where a scene is seen.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lab/render/draw_list.hpp"
#include "scene/effects.hpp"

namespace gobo::scene {

/// From where a picture of a scene is taken, and onto what.
struct SceneView {
    glm::dmat4 view{1};        ///< world to eye space
    glm::dmat4 projection{1};  ///< eye to clip space
    int width = 512;           ///< pixels
    int height = 512;
    std::array<float, 4> background = {0, 0, 0, 1};  ///< linear
};

/// The view of a camera, by its number in the file; nothing where no node of the scene holds it. Its node's
/// scale does not count (glTF 2.0 specification, 3.10.1); the picture's shape replaces the camera's own.
[[nodiscard]] std::optional<SceneView> view_of_camera(const Scene& scene, std::size_t camera, int width,
                                                      int height);

/// The number of the first camera that a node of the scene holds.
[[nodiscard]] std::optional<std::size_t> first_camera(const Scene& scene);

/// A view from `direction` (away from what is seen; not zero) that has all draws in it. What has no bounds
/// does not count.
[[nodiscard]] SceneView view_of_all(const std::vector<Draw>& draws, const glm::dvec3& direction, int width,
                                    int height);

/// What stands behind a scene: what it states itself, else its fog's colour, or the colour that `gobo render`
/// has for families.
[[nodiscard]] std::array<float, 4> background_of(const Scene& scene);

/// The view's part of what values are made of.
[[nodiscard]] ViewedObject viewed_by(const SceneView& view);

}  // namespace gobo::scene
