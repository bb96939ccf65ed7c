// The smaller levels of a texture: what stands in for a picture that is seen from afar.
#pragma once

#include <vector>

#include "scene/picture.hpp"

namespace gobo::scene {

/// The picture, then each smaller level down to one texel. A level's sides are half those of the level above,
/// rounded down (OpenGL 4.5, 8.14.3); its texels are the means of what they cover there, weighted by area.
/// The colours of an sRGB picture are averaged as linear light and stored as sRGB again.
[[nodiscard]] std::vector<TextureImage> picture_levels(const TextureImage& picture, bool is_srgb);

}  // namespace gobo::scene
