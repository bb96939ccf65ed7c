#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <lodepng.h>

namespace teapot {
namespace {

unsigned char encode(float radiance) {
    const float exposed = 1 - std::exp(-radiance);
    const float srgb =
        exposed <= 0.0031308f ? 12.92f * exposed : 1.055f * std::pow(exposed, 1 / 2.4f) - 0.055f;
    return static_cast<unsigned char>(std::lround(255 * srgb));
}

}  // namespace

Picture develop(const Radiance& radiance) {
    const Size size{radiance.size.width / samples, radiance.size.height / samples};
    Picture picture{size, {}};
    for (int pixel = 0; pixel < size.width * size.height; ++pixel) {
        const int left = pixel % size.width * samples;
        const int bottom = (size.height - 1 - pixel / size.width) * samples;
        glm::vec4 sum(0);
        for (int sample = 0; sample < samples * samples; ++sample) {
            const int x = left + sample % samples;
            const int y = bottom + sample / samples;
            sum += radiance.pixels[static_cast<std::size_t>(y * radiance.size.width + x)];
        }
        for (int channel = 0; channel < 3; ++channel)
            picture.pixels.push_back(encode(sum[channel] / (samples * samples)));
        picture.pixels.push_back(255);
    }
    return picture;
}

Picture arrange(const std::vector<Picture>& pictures, int columns) {
    const Size one = pictures.front().size;
    const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
    Picture sheet{{one.width * columns, one.height * rows}, {}};
    sheet.pixels.resize(static_cast<std::size_t>(4 * sheet.size.width * sheet.size.height));
    for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
        for (int y = 0; y < one.height; ++y) {
            const auto& pixels = pictures[static_cast<std::size_t>(i)].pixels;
            const int to = ((i / columns) * one.height + y) * sheet.size.width + (i % columns) * one.width;
            std::copy_n(pixels.begin() + 4 * y * one.width, 4 * one.width, sheet.pixels.begin() + 4 * to);
        }
    }
    return sheet;
}

void write_png(const std::string& path, const Picture& picture) {
    const unsigned error = lodepng::encode(path, picture.pixels, static_cast<unsigned>(picture.size.width),
                                           static_cast<unsigned>(picture.size.height));
    if (error != 0) throw std::runtime_error(path + ": " + lodepng_error_text(error));
}

}  // namespace teapot
