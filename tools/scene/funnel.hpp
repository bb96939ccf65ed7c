// How few permutations remain of how many, and what light-count buckets cost.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/scene_keys.hpp"

namespace gobo::scene {

/// The numbers from the family down to the scene. What only composing tells is not among them.
struct Funnel {
    std::uint64_t full_product = 0;  ///< of the numbers of values of all features
    std::uint64_t valid = 0;         ///< keys that the family's rules allow
    std::size_t draws = 0;
    std::size_t called_for = 0;  ///< keys of the draws, as they are
    std::size_t bucketed = 0;    ///< after light counts are rounded up
};

/// One way of rounding light counts up, and its price.
struct BucketingRow {
    Buckets buckets;
    std::size_t permutations = 0;
    int lights = 0;         ///< that the draws call for, summed
    int shaded_lights = 0;  ///< that their permutations shade, summed
};

[[nodiscard]] Result<Funnel> measure_funnel(const Family& family, const std::vector<Draw>& draws,
                                            const Buckets& buckets, std::string_view dialect);

/// The usual bucketings and, where it is none of them, `chosen`.
[[nodiscard]] Result<std::vector<BucketingRow>> compare_bucketings(const Family& family,
                                                                   const std::vector<Draw>& draws,
                                                                   const Buckets& chosen,
                                                                   std::string_view dialect);

}  // namespace gobo::scene
