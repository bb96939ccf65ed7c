// Pictures of floats.
#pragma once

#include <cstddef>
#include <vector>

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

/// How far two values are apart. A NaN facing anything but a NaN is an infinite difference; equal infinities
/// and two NaNs are none.
[[nodiscard]] float absolute_difference(float first, float second);

/// The picture with each square of `factor` x `factor` pixels averaged to one. The sides must be multiples of
/// it.
[[nodiscard]] Image shrunk(const Image& picture, int factor);

/// A picture of the absolute differences, from black (none) through red and yellow to white (`scale` and
/// above). The images must be of one size.
[[nodiscard]] Image difference_picture(const Image& first, const Image& second, float scale);

}  // namespace gobo
