// Of a family's domains the part that a scene holds.
#pragma once

#include <vector>

#include "scene/draw_values.hpp"

namespace gobo::scene {

/// For each domain that some draw has a value of, the range of all draws' values, in floats, at the scene's
/// place: materials, the colours and cones of lights, fog. Nothing of places and directions, which hang on
/// the camera, nor of what a domain is the length of.
[[nodiscard]] std::vector<Domain> domains_of_scene(const Scene& scene, const std::vector<Draw>& draws,
                                                   const std::vector<Domain>& of_family);

}  // namespace gobo::scene
