// Families and scenes of the source tree, for tests that draw.
#pragma once

#include <string>
#include <vector>

#include "compose/search_path.hpp"
#include "core/file_system.hpp"
#include "family/family.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lab/scene_picture/draw_scene.hpp"

namespace gobo::scene {

/// A shipped family with its pieces, or `uber` of tests/ubershader, as they stand in the source tree.
struct ShippedFamily {
    explicit ShippedFamily(const std::string& name);
    DiskFileSystem files;
    Family family;
    SearchPath search;
};

/// What shadow maps of that size are drawn with: the family `depth`.
[[nodiscard]] DepthPass shipped_depth_pass(int side);

/// A scene of tests/assets/scenes/, which must be in order.
[[nodiscard]] Scene shipped_scene(const std::string& file);

/// The names of the scenes of tests/assets/scenes/, sorted.
[[nodiscard]] std::vector<std::string> shipped_scenes();

}  // namespace gobo::scene
