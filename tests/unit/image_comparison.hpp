// How far two pictures differ.
#pragma once

#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/render/image.hpp"

namespace gobo {

/// A pixel where two pictures differ, with both values.
struct PixelDifference {
    int x = 0;
    int y = 0;
    float difference = 0;  ///< the largest absolute one of the channels
    std::vector<float> first;
    std::vector<float> second;
};

/// How far two pictures of one size differ, over all values of all channels. A NaN facing anything but a NaN
/// counts as an infinite difference; equal infinities and two NaNs as none.
struct Comparison {
    double largest = 0;         ///< absolute
    double percentile_999 = 0;  ///< 99.9 % of the absolute differences are at most this
    double root_mean_square = 0;
    std::vector<PixelDifference> worst;  ///< largest first; on ties by row, then column
};

/// Fault::input where the sizes or channels differ. At most `worst_count` pixels are listed, only differing
/// ones.
[[nodiscard]] Result<Comparison> compare(const Image& first, const Image& second,
                                         std::size_t worst_count = 10);

/// The comparison in words, a line for the figures and one per pixel.
[[nodiscard]] std::string to_text(const Comparison& comparison);

}  // namespace gobo
