// Textures that answer from data: what a caller may give for the samplers of a stage.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::evaluate {

/// What a texture of one colour answers: its size (`side` texels, as many levels as that has), the colour, or
/// for a shadow lookup whether the reference is at most its first component.
[[nodiscard]] std::array<double, 4> answer(const std::array<double, 4>& color, const ImageRequest& request,
                                           double side = 4);

/// Depths, layer after layer, row after row from y = 0: a sampler2DArrayShadow.
struct DepthTexels {
    int width = 1;
    int height = 1;
    int layers = 1;
    std::vector<double> depths;
};

/// As OpenGL with one level, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_COMPARE_REF_TO_TEXTURE and GL_LEQUAL: the four
/// comparisons around, weighted. A fetch answers the depth itself.
[[nodiscard]] std::array<double, 4> answer(const DepthTexels& texels, const ImageRequest& request);

/// Row after row from t = 0, repeated beyond both ends (GL_REPEAT).
struct ColorTexels {
    int width = 1;
    int height = 1;
    std::vector<std::array<float, 4>> colors;
};

/// The faces +x -x +y -y +z -z one after the other, each row after row from t = 0; filtered across the edges
/// between them (GL_TEXTURE_CUBE_MAP_SEAMLESS).
struct CubeTexels {
    int side = 1;
    std::vector<std::array<float, 4>> colors;
};

/// Sampled: the four texels around (OpenGL 4.5, 8.14.3); in the corner of a cube three, whose mean stands for
/// the fourth (8.15). Fetched: the texel. The weights are exact where a driver's have some 8 to 24 bits.
[[nodiscard]] std::array<double, 4> answer(const ColorTexels& texels, const ImageRequest& request);
[[nodiscard]] std::array<double, 4> answer(const CubeTexels& texels, const ImageRequest& request);

/// A colour that changes evenly: `color` plus each coordinate times `along` it. Coordinates of a cube map are
/// those of the unit vector. Without slopes a texture of one colour, which is also a depth everywhere.
struct EvenColor {
    std::array<double, 4> color{};
    std::array<std::array<double, 4>, 3> along{};
};

/// Texels of a few colours: which of them one has follows from where it lies, by `seed`, as if drawn at
/// random. Nothing is filtered. A stage can tell it from a large picture only by texels that happen to be the
/// same.
struct TexelPattern {
    std::vector<std::array<double, 4>> colors;  ///< at least one
    int seed = 0;
    int side = 0;    ///< texels along each; 0: nobody says, and 64 are answered
    int levels = 0;  ///< 0: as many as the side allows

    [[nodiscard]] int known_side() const { return side > 0 ? side : 64; }
    [[nodiscard]] int known_levels() const;
};

/// Coordinates of a cube map are directions. Beyond an edge the texture repeats.
[[nodiscard]] std::array<double, 4> answer(const TexelPattern& pattern, const ImageRequest& request,
                                           bool is_cube);

/// An image of one pattern for each point, which has so many invocations.
struct PatternImage {
    std::shared_ptr<const std::vector<TexelPattern>> of_points;
    std::size_t invocations_of_point = 1;
    bool is_cube = false;

    [[nodiscard]] const TexelPattern& at(std::size_t invocation) const {
        return (*of_points)[std::min(invocation / invocations_of_point, of_points->size() - 1)];
    }
    std::array<double, 4> operator()(const ImageRequest& request) const {
        return answer(at(request.invocation), request, is_cube);
    }
};

/// The pattern that an invocation is given; nullptr where the image is another one.
[[nodiscard]] const TexelPattern* pattern_of(const Image& image, std::size_t invocation);

using TextureContent = std::variant<EvenColor, DepthTexels>;

/// The image that answers from the content, as a sampler of that type.
[[nodiscard]] Image image_of(TextureContent content, const spirv::Image& type);

/// What an image holds for one invocation, found by asking it: texel by texel where it holds depths of a size
/// of their own, along the axes where it is a cube map, else at one place, which is all of a texture of one
/// colour.
[[nodiscard]] TextureContent content_of(const Image& image, const ImagePort& port, std::size_t invocation);

/// Numbers by the sampler's name, and those that one list does not hold by the name and a member:
/// "map" for one colour; "map.color", "map.along_x", "map.along_y", "map.along_z" for one that changes;
/// "map.size" (columns, rows, layers) and "map.depths" (layer by layer, row by row from the lowest);
/// "map.texels" (colour after colour), "map.seed", "map.side" and "map.levels" for a pattern.
using SamplerNumbers = std::map<std::string, std::vector<double>>;

void add_numbers(const std::string& sampler, const TextureContent& content, SamplerNumbers& numbers);
void add_numbers(const std::string& sampler, const TexelPattern& pattern, SamplerNumbers& numbers);

}  // namespace gobo::evaluate
