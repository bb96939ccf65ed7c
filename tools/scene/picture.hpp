// Pictures in files: the one place where they are decoded.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace gobo::scene {

/// A picture of 8 bits a channel, row after row from the top (where texture coordinates are 0).
struct TextureImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> texels;  ///< four each: red, green, blue, alpha
};

/// As many pixels as all accessors of a scene together may hold numbers: a picture of 8192 by 8192.
inline constexpr std::size_t kMostTexels = 67'108'864;

enum class PictureFormat { png, jpeg, unknown };
/// By the first bytes.
[[nodiscard]] PictureFormat format_of_picture(std::string_view bytes);

/// Why there is no picture.
struct NoPicture {
    std::string message;  ///< the end of a sentence that begins with what the picture is
    std::string help;     ///< what to do; may be empty
};

/// Decodes a PNG or a JPEG.
[[nodiscard]] tl::expected<TextureImage, NoPicture> decode_picture(std::string_view bytes);

}  // namespace gobo::scene
