// Which qualities of a combination of effects a study measures.
#pragma once

#include <vector>

#include "lab/study/variants.hpp"
#include "lab/study/weights.hpp"

namespace gobo::study {

/// All qualities, where they are at most this many; otherwise those that a screening finds near the front.
inline constexpr std::size_t kMeasuredWithoutScreening = 128;
/// More qualities than this are not even screened: then only single choices are measured.
inline constexpr std::size_t kMostScreened = 16384;

struct Candidates {
    std::vector<Key> keys;  ///< the most accurate one first, then every single choice, then the others
    std::size_t considered = 0;
};

/// Screens on a few points of each scene: a quality stays unless another one is both clearly cheaper and
/// clearly more accurate.
[[nodiscard]] Result<Candidates> find_candidates(const Family& family, const SearchPath& search,
                                                 const Key& effects, const std::vector<DrawnScene>& scenes,
                                                 const Weights& weights, int jobs);

}  // namespace gobo::study
