// A scene as a selection of keys.
#pragma once

#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "gobo/command.hpp"

namespace gobo {

/// The keys that the draws of a scene need, seen from any of its cameras, as `gobo scene --keys` lists
/// them. The scene and its buffers are added to `family.files`. Fault::input where the scene draws no
/// triangles: an empty selection would mean the family's default set.
[[nodiscard]] Result<std::vector<NamedKey>> keys_of_scene(const World& world, LoadedFamily& family,
                                                          const std::string& path,
                                                          const std::string& bucket_lights, Dialect dialect);

}  // namespace gobo
