// Pictures of floats, and how far two of them differ.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

/// Linear radiance, or depth, as floats. Rows run from the top down; channels are interleaved.
struct Image {
    Image() = default;
    Image(int width_, int height_, int channels_)
        : width(width_),
          height(height_),
          channels(channels_),
          values(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                 static_cast<std::size_t>(channels_)) {}

    int width = 0;
    int height = 0;
    int channels = 0;  ///< 1, 3 or 4
    std::vector<float> values;

    [[nodiscard]] float& at(int x, int y, int channel) { return values[index(x, y, channel)]; }
    [[nodiscard]] float at(int x, int y, int channel) const { return values[index(x, y, channel)]; }

    friend bool operator==(const Image&, const Image&) = default;

  private:
    [[nodiscard]] std::size_t index(int x, int y, int channel) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(channel);
    }
};

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

/// The picture with each square of `factor` x `factor` pixels averaged to one. The sides must be multiples of
/// it.
[[nodiscard]] Image shrunk(const Image& picture, int factor);

/// A picture of the absolute differences, from black (none) through red and yellow to white (`scale` and
/// above). The images must be of one size.
[[nodiscard]] Image difference_picture(const Image& first, const Image& second, float scale);

}  // namespace gobo
