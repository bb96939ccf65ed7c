#include "lab/gallery/exposure.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::gallery {
namespace {

/// The largest colour that is not infinite, of each pixel.
std::vector<float> brightness_of(const Image& picture) {
    std::vector<float> all;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            float largest = 0;
            for (int channel = 0; channel < std::min(picture.channels, 3); ++channel)
                if (std::isfinite(picture.at(x, y, channel)))
                    largest = std::max(largest, picture.at(x, y, channel));
            all.push_back(largest);
        }
    }
    return all;
}

}  // namespace

float exposure_of(const Image& picture) {
    constexpr float kWhite = 0.95F;  // leaves the brightest hundredth room to shine
    std::vector<float> brightness = brightness_of(picture);
    if (brightness.empty()) return 1;
    const auto place = brightness.begin() + static_cast<std::ptrdiff_t>(brightness.size() / 100);
    std::nth_element(brightness.begin(), place, brightness.end(), std::greater<>());
    return *place > kWhite ? kWhite / *place : 1;
}

Image exposed(Image picture, float exposure) {
    const auto channels = static_cast<std::size_t>(picture.channels);
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        if (channels < 4 || i % channels < 3) picture.values[i] *= exposure;
    return picture;
}

}  // namespace gobo::gallery
