// A scene drawn with the permutations that it needs.
#pragma once

#include <set>
#include <string>

#include "renderer.hpp"
#include "scene_file.hpp"

namespace teapot {

/// Draws everything; `aspect` is width over height. Returns the keys that were asked for, as text. Throws
/// std::runtime_error where a permutation was not built.
std::set<std::string> draw(Renderer& renderer, const Scene& scene, float aspect);

}  // namespace teapot
