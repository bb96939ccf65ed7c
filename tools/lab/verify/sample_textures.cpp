#include "lab/verify/sample_textures.hpp"

#include <memory>
#include <optional>
#include <vector>

#include "lab/evaluate/images.hpp"

namespace gobo::verify {
namespace {

using evaluate::DepthTexels;
using evaluate::EvenColor;
using evaluate::TextureContent;

EvenColor content_of(const oracle::CubeMap& map) {
    EvenColor even{{map.mean.r, map.mean.g, map.mean.b, 1}, {}};
    for (int axis = 0; axis < 3; ++axis)
        for (int channel = 0; channel < 3; ++channel)
            even.along[static_cast<std::size_t>(axis)][static_cast<std::size_t>(channel)] =
                map.slope[axis][channel];
    return even;
}

oracle::CubeMap cube_map_of(const EvenColor& even) {
    oracle::CubeMap map;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        map.mean[static_cast<int>(channel)] = even.color[channel];
        for (std::size_t axis = 0; axis < 3; ++axis)
            map.slope[static_cast<int>(axis)][static_cast<int>(channel)] = even.along[axis][channel];
    }
    return map;
}

/// What the sampler of that name holds; nothing where samples do not know it.
std::optional<TextureContent> content_of(const Sample& sample, std::string_view sampler) {
    if (sampler == "opacityMap") return EvenColor{{0, 0, 0, sample.surface.opacity}, {}};
    if (sampler == "diffuseMap") return content_of(sample.scene.image_light.map);
    if (sampler == "specularMap") return content_of(sample.scene.reflection.map);
    if (sampler != "shadowMaps") return std::nullopt;
    const oracle::DepthMaps& maps = sample.scene.maps;
    return DepthTexels{maps.width, maps.height, maps.layers, maps.depths};
}

oracle::DepthMaps depth_maps_of(const TextureContent& content) {
    if (const auto* texels = std::get_if<DepthTexels>(&content))
        return {texels->width, texels->height, texels->layers, texels->depths};
    return {1, 1, 1, {std::get<EvenColor>(content).color[0]}};
}

}  // namespace

void feed_textures(const evaluate::Program& program, std::span<const Sample> samples,
                   evaluate::Invocations& invocations) {
    for (const evaluate::ImagePort& port : program.images) {
        const auto images = std::make_shared<std::vector<evaluate::Image>>();
        for (const Sample& sample : samples)
            if (const auto content = content_of(sample, port.name))
                images->push_back(evaluate::image_of(*content, port.type));
        if (images->empty()) continue;
        invocations.images[port.name] = [images](const evaluate::ImageRequest& request) {
            return (*images)[request.invocation](request);
        };
    }
}

bool read_textures(const evaluate::Program& program, const evaluate::Invocations& invocations,
                   Sample& sample) {
    for (const evaluate::ImagePort& port : program.images) {
        const auto given = invocations.images.find(port.name);
        if (given == invocations.images.end()) return false;
        const TextureContent content = evaluate::content_of(given->second, port, 0);
        if (port.name == "opacityMap") {
            evaluate::ImageRequest request;
            request.coordinates = {sample.texture_coordinate.x, sample.texture_coordinate.y, 0, 0};
            sample.surface.opacity = given->second(request)[3];
        } else if (port.name == "diffuseMap") {
            sample.scene.image_light.map = cube_map_of(std::get<EvenColor>(content));
        } else if (port.name == "specularMap") {
            sample.scene.reflection.map = cube_map_of(std::get<EvenColor>(content));
        } else if (port.name == "shadowMaps") {
            sample.scene.maps = depth_maps_of(content);
        } else {
            return false;
        }
    }
    return true;
}

}  // namespace gobo::verify
