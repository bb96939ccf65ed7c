// The ubershader in the place of a permutation of `lit`: its key, and what its switches hold.
#pragma once

#include <vector>

#include "family/family.hpp"

namespace gobo::scene {

/// How an ubershader finds its lights: one array of ten with switches each, or arrays for each kind with
/// counts that are read at run time.
enum class UberLights { switched, looped };

/// The key of `uber` that can do what any permutation of `lit` does that has this one's quality and pipeline:
/// every feature that can be switched is, lights are found at run time.
[[nodiscard]] Key uber_key(const Family& uber, const Family& lit, const Key& key, UberLights lights);

/// The values of a permutation's uniforms with those that make the ubershader do the same. Lights stand in
/// the order directional, point, spot, directional_or_point, as the permutation adds them; shadows are those
/// of the block `Shadows` among the values.
[[nodiscard]] std::vector<RenderValue> uber_values(const Family& uber, const Family& lit, const Key& key,
                                                   std::vector<RenderValue> values);

/// The values of the block `Shadows` alone, as they are found once a view is known, under the ubershader's
/// names.
[[nodiscard]] std::vector<RenderValue> uber_shadow_values(const Family& lit, const Key& key,
                                                          const std::vector<RenderValue>& shadows);

/// The lights that the key counts, in all.
[[nodiscard]] int lights_of(const Family& lit, const Key& key);

/// How many lights the array of switched lights holds.
inline constexpr int kSwitchedLights = 10;

}  // namespace gobo::scene
