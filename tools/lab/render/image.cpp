#include "lab/render/image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gobo {

float absolute_difference(float first, float second) {
    if (first == second || (std::isnan(first) && std::isnan(second))) return 0;
    const float difference = std::abs(first - second);
    return std::isnan(difference) ? std::numeric_limits<float>::infinity() : difference;
}

Image shrunk(const Image& picture, int factor) {
    Image small(picture.width / factor, picture.height / factor, picture.channels);
    const float weight = 1 / static_cast<float>(factor * factor);
    for (int y = 0; y < small.height * factor; ++y)
        for (int x = 0; x < small.width * factor; ++x)
            for (int channel = 0; channel < picture.channels; ++channel)
                small.at(x / factor, y / factor, channel) += weight * picture.at(x, y, channel);
    return small;
}

Image difference_picture(const Image& first, const Image& second, float scale) {
    Image picture(first.width, first.height, 3);
    for (int y = 0; y < first.height; ++y) {
        for (int x = 0; x < first.width; ++x) {
            float largest = 0;
            for (int channel = 0; channel < first.channels; ++channel)
                largest =
                    std::max(largest, absolute_difference(first.at(x, y, channel), second.at(x, y, channel)));
            const float heat = 3 * std::min(largest / scale, 1.0F);
            for (int channel = 0; channel < 3; ++channel)
                picture.at(x, y, channel) = std::clamp(heat - static_cast<float>(channel), 0.0F, 1.0F);
        }
    }
    return picture;
}

}  // namespace gobo
