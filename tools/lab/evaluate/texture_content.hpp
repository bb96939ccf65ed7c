// What a texture holds, in numbers that a file can name: the form in which `gobo eval` is given its samplers.
#pragma once

#include <array>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "lab/evaluate/images.hpp"

namespace gobo::evaluate {

/// A colour that changes evenly: `color` plus each coordinate times `along` it. Coordinates of a cube map are
/// those of the unit vector. Without slopes a texture of one colour, which is also a depth everywhere.
struct EvenColor {
    std::array<double, 4> color{};
    std::array<std::array<double, 4>, 3> along{};
};

using TextureContent = std::variant<EvenColor, DepthTexels>;

/// The image that answers from the content, as a sampler of that type.
[[nodiscard]] Image image_of(TextureContent content, const ImageType& type);

/// What an image holds for one invocation, found by asking it: texel by texel where it holds depths of a size
/// of their own, along the axes where it is a cube map, else at one place, which is all of a texture of one
/// colour.
[[nodiscard]] TextureContent content_of(const Image& image, const ImagePort& port, std::size_t invocation);

/// Numbers by the sampler's name, and those that one list does not hold by the name and a member:
/// "map" for one colour; "map.color", "map.along_x", "map.along_y", "map.along_z" for one that changes;
/// "map.size" (columns, rows, layers) and "map.depths" (layer by layer, row by row from the lowest).
using SamplerNumbers = std::map<std::string, std::vector<double>>;

void add_numbers(const std::string& sampler, const TextureContent& content, SamplerNumbers& numbers);

}  // namespace gobo::evaluate
