// From what draws call for to the keys of a family.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "family/family.hpp"
#include "scene/effects.hpp"

namespace gobo::scene {

/// Light counts that permutations are built for, rising; a draw takes the least that is enough. Empty: every
/// count.
using Buckets = std::vector<int>;

/// Reads "0,1,2,4,8": whole numbers from 0 to 1000000 that rise. Fault::usage otherwise.
[[nodiscard]] Result<Buckets> parse_buckets(std::string_view text);
/// "0,1,2,4,8", or "every count".
[[nodiscard]] std::string buckets_text(const Buckets& buckets);

/// The permutation that a draw needs.
struct DrawKey {
    Key key;                           ///< canonical
    int lights = 0;                    ///< that the draw calls for
    int shaded_lights = 0;             ///< that the permutation shades; the others are given no colour
    std::vector<std::string> missing;  ///< effects that are in, but that the family does not shade, with why
};

/// One entry per draw; nothing for an excluded one. Fault::input where a rule of the family forbids what a
/// draw calls for.
[[nodiscard]] Result<std::vector<std::optional<DrawKey>>> keys_for_draws(const Family& family,
                                                                         const std::vector<Draw>& draws,
                                                                         const Buckets& buckets,
                                                                         std::string_view dialect);

/// The distinct keys of draws, sorted.
[[nodiscard]] std::vector<Key> distinct_keys(const std::vector<std::optional<DrawKey>>& draws);

}  // namespace gobo::scene
