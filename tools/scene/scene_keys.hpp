// From the effects that draws need to the keys of a family, how few they are of how many, and what
// light-count buckets cost.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/whole_number.hpp"
#include "family/family.hpp"
#include "scene/effects.hpp"
#include "scene/read_scene.hpp"

namespace gobo::scene {

/// Light counts that permutations are built for, rising; a draw takes the least that is enough. Empty: every
/// count.
using Buckets = std::vector<int>;

/// Reads "0,1,2,4,8": whole numbers from 0 to 1000000 that rise. Fault::usage otherwise.
[[nodiscard]] Result<Buckets> parse_buckets(std::string_view text);
/// "0,1,2,4,8", or "every count".
[[nodiscard]] std::string buckets_text(const Buckets& buckets);

/// How a scene is read for a family: by the pictures that its materials have.
[[nodiscard]] Reading reading_for(const Family& family);

/// The permutation that a draw needs.
struct DrawKey {
    std::string name;                  ///< the draw's
    Key effects;                       ///< what its effects ask for, before light counts are rounded up
    Key key;                           ///< canonical
    int lights = 0;                    ///< that the draw needs
    int shaded_lights = 0;             ///< that the permutation shades; the others are given no colour
    std::vector<std::string> missing;  ///< effects that are in, but that the family does not shade, with why
};

/// One entry per draw; nothing for an excluded one. Fault::input where a rule of the family forbids what a
/// draw needs.
[[nodiscard]] Result<std::vector<std::optional<DrawKey>>> keys_for_draws(const Family& family,
                                                                         const std::vector<Draw>& draws,
                                                                         const Buckets& buckets,
                                                                         std::string_view dialect);

/// The keys of all draws of a scene, without what is `missing`, and notes_on_scene() on them.
struct SceneKeys {
    std::vector<std::optional<DrawKey>> keys;  ///< one per draw; nothing for an excluded one
    std::vector<std::string> notes;
};

/// As keys_for_draws(), without the effects of all draws at once.
[[nodiscard]] Result<SceneKeys> keys_for_scene(const Family& family, const SceneDraws& draws,
                                               const Buckets& buckets, std::string_view dialect);

/// The effects of the draw that are in, but that the family does not shade, with why.
[[nodiscard]] std::vector<std::string> missing_effects(const Family& family, const Draw& draw);

/// Lines on what these keys do not show of the scene, each thing once: "FILE: not drawn: sheen, 2 draws of
/// lines"; and where it is read for `lit`, what `pbr` would make of it.
[[nodiscard]] std::vector<std::string> notes_on_scene(const Scene& scene, const std::vector<Draw>& draws,
                                                      const std::vector<std::optional<DrawKey>>& keys);

/// The distinct keys of draws, sorted.
[[nodiscard]] std::vector<Key> distinct_keys(const std::vector<std::optional<DrawKey>>& draws);

/// The numbers from the family down to the scene. What only composing tells is not among them.
struct Funnel {
    WholeNumber full_product = 1;  ///< of the numbers of values of all features
    WholeNumber valid;             ///< keys that the family's rules allow
    std::size_t draws = 0;
    std::size_t needed = 0;    ///< keys of the draws, as they are
    std::size_t bucketed = 0;  ///< after light counts are rounded up
};

[[nodiscard]] Result<Funnel> measure_funnel(const Family& family,
                                            const std::vector<std::optional<DrawKey>>& draws,
                                            const Buckets& buckets, std::string_view dialect);

/// One way of rounding light counts up, and its price.
struct BucketingRow {
    Buckets buckets;
    std::size_t permutations = 0;
    int lights = 0;         ///< that the draws need, summed
    int shaded_lights = 0;  ///< that their permutations shade, summed
};

/// The usual bucketings and, where it is none of them, `chosen`.
[[nodiscard]] Result<std::vector<BucketingRow>> compare_bucketings(
    const Family& family, const std::vector<std::optional<DrawKey>>& draws, const Buckets& chosen,
    std::string_view dialect);

}  // namespace gobo::scene
