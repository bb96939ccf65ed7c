// Whether what a family file names stands in its shaders.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "gobo/input.hpp"
#include "validate/validate.hpp"

namespace gobo {

/// The key with every count at its highest; nothing where a rule forbids or changes it.
[[nodiscard]] std::optional<Key> with_highest_counts(const LoadedFamily& family, Key key);

/// The interfaces of a cover of that strength, and of its keys with_highest_counts().
using InterfacesOfCover = std::function<std::vector<Interface>(int strength)>;

/// An error for each name under [domain], [render], [[relations]] and [[descriptor_sets]] of the family's own
/// file that stands for nothing in any key's shaders. What no key of the composition has is looked for in the
/// texts of all keys; what its shaders declare otherwise, in a cover.
[[nodiscard]] Diagnostics unknown_names(const LoadedFamily& family, const Composition& composition,
                                        const Validated& validated, const InterfacesOfCover& more);

}  // namespace gobo
