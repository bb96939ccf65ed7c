// From linear radiance to PNG.
#pragma once

#include <string>
#include <vector>

#include <glm/vec4.hpp>

namespace teapot {

/// Pixels across and down.
struct Size {
    int width;
    int height;
};

/// Linear radiance as OpenGL reads it: the bottom row first.
struct Radiance {
    Size size;
    std::vector<glm::vec4> pixels;
};

/// Eight-bit sRGB with alpha, the top row first.
struct Picture {
    Size size;
    std::vector<unsigned char> pixels;
};

/// How many samples across and down make a pixel.
constexpr int samples = 2;

/// Averages the samples of each pixel, maps [0, infinity) to [0, 1) as film does, and encodes as sRGB.
Picture develop(const Radiance& radiance);

/// Pictures of one size side by side, `columns` to a row.
Picture arrange(const std::vector<Picture>& pictures, int columns);

/// Throws std::runtime_error where the file cannot be written.
void write_png(const std::string& path, const Picture& picture);

}  // namespace teapot
