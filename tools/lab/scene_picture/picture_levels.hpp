// The smaller levels of a texture: what stands in for a picture that is seen from afar.
#pragma once

#include <vector>

#include "scene/picture.hpp"
#include "scene/scene.hpp"

namespace gobo::scene {

/// The picture, then each smaller level down to one texel. A level's sides are half those of the level above,
/// rounded down (OpenGL 4.5, 8.14.3); its texels are the means of what they cover there, weighted by area.
/// The colours of an sRGB picture are averaged as linear light and stored as sRGB again.
[[nodiscard]] std::vector<TextureImage> picture_levels(const TextureImage& picture, bool is_srgb);

/// The levels from the first on whose sides are at most `most` texels, the renderer's largest texture; where
/// that is not the first of all, a warning says so.
[[nodiscard]] std::vector<TextureImage> levels_within(int most, std::vector<TextureImage> levels,
                                                      Diagnostics& warnings);

/// The map at `draw` made to fit in the same way; where the draw has none, one texel that is opaque.
[[nodiscard]] AlphaMap alpha_map_within(int most, const std::vector<AlphaMap>& maps, std::size_t draw,
                                        Diagnostics& warnings);

}  // namespace gobo::scene
