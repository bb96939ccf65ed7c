// OpenEXR in memory. Internal to tools/render.
#pragma once

#include <string>
#include <string_view>

#include "lab/render/image.hpp"

namespace gobo {

[[nodiscard]] Result<std::string> encode_exr(const Image& image);
[[nodiscard]] Result<Image> decode_exr(std::string_view bytes, const std::string& path);

}  // namespace gobo
