// Covering arrays under constraints: few keys that together hold every possible combination of T feature
// values.
#pragma once

#include <optional>
#include <vector>

#include "family/key_space.hpp"

namespace gobo {

/// Covers of more features at once have too many keys to be of use.
inline constexpr int kLargestCover = 8;

/// Keys of the space that together contain every combination of `strength` feature values that some key of
/// the space contains. Sorted; the same for the same space. A strength above the number of features asks for
/// all keys. Nothing where rules tie so many values together that it would take minutes.
///
/// Greedy, one key at a time, as in AETG (Cohen, Dalal, Fredman, Patton: The AETG System, IEEE TSE 23(7),
/// 1997): a key starts from a combination not covered yet, and each further feature takes the value that
/// covers most new ones; of several orders of features the best is taken.
[[nodiscard]] std::optional<std::vector<Key>> cover(const KeySpace& space, int strength);

}  // namespace gobo
