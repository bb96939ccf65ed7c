// What shader files that no family names say of how they are to be read.
#pragma once

#include <vector>

#include "compose/composition.hpp"
#include "family/family.hpp"

namespace gobo {

/// Whether they are written in GLSL for Vulkan, which OpenGL's compilers refuse.
[[nodiscard]] bool is_for_vulkan(const Composition& composition);

/// Whether they mention what OpenGL had built in before 3.1, or are of that time and state no version; the
/// family then declares it (`compatibility = true`).
[[nodiscard]] bool read_as_legacy(const Composition& composition, Family& family);

/// Makes a feature of each subroutine uniform in them. False where there is none.
[[nodiscard]] bool add_subroutines(const Composition& composition, Family& family);

/// As few keys as have every value of every feature.
[[nodiscard]] std::vector<Key> keys_with_every_value(const Family& family);

}  // namespace gobo
