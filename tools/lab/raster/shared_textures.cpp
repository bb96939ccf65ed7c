#include "lab/raster/shared_textures.hpp"

#include <algorithm>
#include <cmath>

#include "lab/evaluate/images.hpp"
#include "lab/render/texture.hpp"

namespace gobo::raster {
namespace {

/// The picture's texels, opaque where it has no alpha.
std::vector<std::array<float, 4>> colors_of(const Image& image) {
    std::vector<std::array<float, 4>> colors;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            std::array<float, 4>& color = colors.emplace_back(std::array<float, 4>{0, 0, 0, 1});
            for (int channel = 0; channel < image.channels; ++channel)
                color[static_cast<std::size_t>(channel)] = image.at(x, y, channel);
        }
    return colors;
}

template <class Texels>
evaluate::Image image_of(Texels texels) {
    return [texels = std::move(texels)](const evaluate::ImageRequest& request) {
        return answer(texels, request);
    };
}

}  // namespace

Result<void> SharedTextures::add(const Interface& interface, const std::vector<RenderValue>& values,
                                 const CubeMaps& cubes) {
    for (const Sampler& sampler : interface.samplers) {
        if (given_.contains(sampler.name) || !sampler.array.empty()) continue;
        const RenderValue* value = find_value(values, sampler.name);
        if (const auto cube = cubes.find(sampler.name);
            cube != cubes.end() && sampler.type == "samplerCube") {
            if (auto added = cubes_.add(sampler.name, cube->second); !added) return added;
            given_[sampler.name] = cubes_.textures().at(sampler.name);
            images_[sampler.name] = colors_of_cube(cube->second);
        } else if (value != nullptr && !value->source.empty() && sampler.type == "sampler2D") {
            const TextureSource source{value->source, value->numbers};
            const auto texture = make_texture(flat_.context(), sampler.type, source, TextureLevels::one);
            if (!texture) continue;
            given_[sampler.name] = *texture;
            flat_.adopt(*texture);
            images_[sampler.name] = colors_of_picture(texture_texels(source));
        }
    }
    return {};
}

evaluate::Image colors_of_cube(const std::vector<Image>& levels) {
    std::vector<evaluate::Image> images;
    for (const Image& faces : levels)
        images.push_back(image_of(evaluate::CubeTexels{faces.width, colors_of(faces)}));
    return [images = std::move(images)](const evaluate::ImageRequest& request) {
        const double held = std::clamp(request.lod, 0.0, static_cast<double>(images.size() - 1));
        const auto finer = static_cast<std::size_t>(held);
        std::array<double, 4> color = images[finer](request);
        if (held == std::floor(held)) return color;
        const std::array<double, 4> coarser = images[finer + 1](request);
        for (std::size_t c = 0; c < 4; ++c)
            color[c] = std::lerp(color[c], coarser[c], held - std::floor(held));
        return color;
    };
}

evaluate::Image colors_of_picture(const Image& picture) {
    return image_of(evaluate::ColorTexels{picture.width, picture.height, colors_of(picture)});
}

std::vector<Image> layers_of(const ShadowMaps& maps, const std::vector<ShadowLight>& lights) {
    int count = 0;
    for (const ShadowLight& light : lights) count += light.kind == ShadowLight::Kind::point ? 6 : 1;
    std::vector<Image> layers;
    for (int i = 0; i < count; ++i) layers.push_back(maps.layer(i));
    return layers;
}

evaluate::Image depths_of(const ShadowMaps& maps, const std::vector<ShadowLight>& lights) {
    return depths_of(layers_of(maps, lights));
}

evaluate::Image depths_of(const std::vector<Image>& layers) {
    evaluate::DepthTexels texels;
    texels.layers = static_cast<int>(layers.size());
    for (const Image& layer : layers) {
        texels.width = layer.width;
        texels.height = layer.height;
        texels.depths.insert(texels.depths.end(), layer.values.begin(), layer.values.end());
    }
    return image_of(std::move(texels));
}

}  // namespace gobo::raster
