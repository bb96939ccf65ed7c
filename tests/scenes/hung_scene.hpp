// The scenes of the tests, with light in all of them, and places to see them from.
#pragma once

#include <string>
#include <vector>

#include "lab/scene_picture/draw_scene.hpp"

namespace gobo::scene {

/// A scene of tests/assets/scenes/. Where the file has no lights, as most models that others made, a
/// directional, a point and a spot light are hung about what it shows.
[[nodiscard]] Scene hung_scene(const std::string& file);

/// A place to see a scene from.
struct Vantage {
    glm::dvec3 eye{0};
    SceneView view;
};

/// The scene's cameras, then directions spread evenly over a sphere, `count` in all.
[[nodiscard]] std::vector<Vantage> vantages(const Scene& scene, std::size_t count, int width, int height);

/// A box around all of them.
[[nodiscard]] EyePlace eyes_of(const std::vector<Vantage>& vantages);

}  // namespace gobo::scene
