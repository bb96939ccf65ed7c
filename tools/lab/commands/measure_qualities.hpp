// Measures the qualities of a combination of effects that a study does not hold, for a budget to choose
// among.
#pragma once

#include <vector>

#include "gobo/command.hpp"

namespace gobo {

/// On the scenes of the family's plan, with the shipped weights, at the qualities that lie on a front of the
/// study; without a study at every single choice.
[[nodiscard]] Result<std::vector<StudiedKey>> measure_qualities(const World& world,
                                                                const LoadedFamily& family,
                                                                const StudiedEffects& studied,
                                                                const Key& effects, int jobs);

}  // namespace gobo
