// Pictures of floats; and as files: PNG for the eye, EXR and PFM for measuring.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/bytes.hpp"
#include "core/file_system.hpp"

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

GOBO_FIELDS(Image, width, height, channels, values)

/// How far two values are apart. A NaN facing anything but a NaN is an infinite difference; equal infinities
/// and two NaNs are none.
[[nodiscard]] float absolute_difference(float first, float second);

/// Red, green, blue and alpha of each texel; 1 for those that the picture has not.
[[nodiscard]] std::vector<float> four_channels(const Image& image);

/// The picture with each square of `factor` x `factor` pixels averaged to one. The sides must be multiples of
/// it.
[[nodiscard]] Image shrunk(const Image& picture, int factor);

/// A picture of the absolute differences, from black (none) through red and yellow to white (`scale` and
/// above). The images must be of one size.
[[nodiscard]] Image difference_picture(const Image& first, const Image& second, float scale);

enum class ImageFormat { png, exr, pfm };

/// "png", "exr" or "pfm": also the end of the file's name.
[[nodiscard]] std::string_view name_of(ImageFormat format);
/// The format of that name. Fault::usage otherwise.
[[nodiscard]] Result<ImageFormat> image_format_of(std::string_view name);

/// The sRGB transfer functions (IEC 61966-2-1) between linear radiance and a display's signal, both in [0,
/// 1].
[[nodiscard]] double srgb_of_linear(double linear);
[[nodiscard]] double linear_of_srgb(double signal);

/// The picture as the bytes of a file. No date, owner or host is written: equal pictures give equal bytes (an
/// EXR under one version of zlib).
///
/// PNG: 8 bits a channel. Colour is clamped to [0, 1] (NaN becomes 0) and sRGB-encoded, alpha clamped and
/// stored as it is; one channel (depth) is clamped and stored as grey without the sRGB curve.
/// EXR: 32-bit floats, ZIP. PFM: 32-bit floats, one or three channels (a fourth is left out), little-endian.
[[nodiscard]] Result<std::string> encode_image(const Image& image, ImageFormat format);

/// The inverse. Fault::input, at `path`, where the bytes are no such file.
/// A PNG gives four channels, its colour made linear. An EXR gives three, or four if it has an A, or one.
[[nodiscard]] Result<Image> decode_image(std::string_view bytes, ImageFormat format, const std::string& path);

/// Encodes by the end of the path's name and writes.
[[nodiscard]] Result<bool> write_image(FileSystem& files, const std::string& path, const Image& image);
[[nodiscard]] Result<Image> read_image(const FileSystem& files, const std::string& path);

}  // namespace gobo
