#include "lab/evaluate/texture_content.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gobo::evaluate {
namespace {

using What = ImageRequest::What;

constexpr std::uint32_t kCubeDimension = 3;  // spv::DimCube
constexpr std::array<const char*, 3> kAlong = {".along_x", ".along_y", ".along_z"};

bool changes(const EvenColor& even) {
    return std::any_of(even.along.begin(), even.along.end(), [](const std::array<double, 4>& slope) {
        return std::any_of(slope.begin(), slope.end(), [](double number) { return number != 0; });
    });
}

bool is_cube(const ImageType& type) {
    return type.dimension == kCubeDimension && !type.depth;
}

std::array<double, 4> answer_evenly(const EvenColor& even, const ImageRequest& request, bool is_cube) {
    if (request.what != What::sample || request.compares || !changes(even))
        return answer(even.color, request);
    const auto& at = request.coordinates;
    const double length = is_cube ? std::hypot(at[0], at[1], at[2]) : 1;
    std::array<double, 4> color = even.color;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t channel = 0; channel < 4; ++channel)
            color[channel] += even.along[axis][channel] * at[axis] / length;
    return color;
}

/// The six directions of a cube map's axes.
EvenColor along_axes(const Image& image, ImageRequest request) {
    EvenColor even;
    request.dimensions = 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        request.coordinates = {};
        request.coordinates[axis] = 1;
        const std::array<double, 4> there = image(request);
        request.coordinates[axis] = -1;
        const std::array<double, 4> back = image(request);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            even.color[channel] = 0.5 * (there[channel] + back[channel]);
            even.along[axis][channel] = 0.5 * (there[channel] - back[channel]);
        }
    }
    return even;
}

DepthTexels texel_by_texel(const Image& image, ImageRequest request, const std::array<double, 4>& size) {
    DepthTexels texels{static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]), {}};
    request.what = What::fetch;
    for (int layer = 0; layer < texels.layers; ++layer)
        for (int y = 0; y < texels.height; ++y)
            for (int x = 0; x < texels.width; ++x) {
                request.coordinates = {static_cast<double>(x), static_cast<double>(y),
                                       static_cast<double>(layer), 0};
                texels.depths.push_back(image(request)[0]);
            }
    return texels;
}

}  // namespace

Image image_of(TextureContent content, const ImageType& type) {
    if (auto* texels = std::get_if<DepthTexels>(&content))
        return [texels = std::move(*texels)](const ImageRequest& request) { return answer(texels, request); };
    return [even = std::get<EvenColor>(content), is_cube = is_cube(type)](const ImageRequest& request) {
        return answer_evenly(even, request, is_cube);
    };
}

TextureContent content_of(const Image& image, const ImagePort& port, std::size_t invocation) {
    ImageRequest request;
    request.invocation = invocation;
    if (is_cube(port.type)) return along_axes(image, request);
    if (port.type.depth) {
        ImageRequest about_size = request;
        about_size.what = What::size;
        const std::array<double, 4> size = image(about_size);
        const bool is_plain =  // a texture of one colour is as large in every direction
            std::all_of(size.begin(), size.end(), [&](double extent) { return extent == size[0]; });
        if (!is_plain) return texel_by_texel(image, request, size);
    }
    return EvenColor{image(request), {}};
}

void add_numbers(const std::string& sampler, const TextureContent& content, SamplerNumbers& numbers) {
    if (const auto* texels = std::get_if<DepthTexels>(&content)) {
        numbers[sampler + ".size"] = {static_cast<double>(texels->width), static_cast<double>(texels->height),
                                      static_cast<double>(texels->layers)};
        numbers[sampler + ".depths"] = texels->depths;
        return;
    }
    const auto& even = std::get<EvenColor>(content);
    const std::vector<double> color(even.color.begin(), even.color.end());
    if (!changes(even)) {
        numbers[sampler] = color;
        return;
    }
    numbers[sampler + ".color"] = color;
    for (std::size_t axis = 0; axis < 3; ++axis)
        numbers[sampler + kAlong[axis]].assign(even.along[axis].begin(), even.along[axis].end());
}

}  // namespace gobo::evaluate
