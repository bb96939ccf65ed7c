#include <array>
#include <map>
#include <tuple>

#include "lab/scene_picture/draw_scene.hpp"
#include "lab/scene_picture/picture_levels.hpp"

namespace gobo::scene {
namespace {

vulkan::TextureLookup::Beyond beyond(int wrap) {
    switch (wrap) {
        case GL_CLAMP_TO_EDGE:
            return vulkan::TextureLookup::Beyond::edge;
        case GL_MIRRORED_REPEAT:
            return vulkan::TextureLookup::Beyond::mirror;
        default:
            return vulkan::TextureLookup::Beyond::repeat;
    }
}

vulkan::TextureLookup lookup_of(const TextureUse& use) {
    const int shrunk = use.min_filter;
    vulkan::TextureLookup lookup;
    lookup.s = beyond(use.wrap_s);
    lookup.t = beyond(use.wrap_t);
    lookup.enlarges_nearest = use.is_nearest;
    lookup.shrinks_nearest =
        shrunk == GL_NEAREST || shrunk == GL_NEAREST_MIPMAP_NEAREST || shrunk == GL_NEAREST_MIPMAP_LINEAR;
    lookup.nearest_level = shrunk == GL_NEAREST_MIPMAP_NEAREST || shrunk == GL_LINEAR_MIPMAP_NEAREST;
    return lookup;
}

/// As floats, of which those of an sRGB picture are linear: they are filtered then as OpenGL filters sRGB.
std::vector<float> floats_of(const TextureImage& level, bool is_srgb) {
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const double signal = static_cast<double>(i) / 255;
        linear[i] = static_cast<float>(is_srgb ? linear_of_srgb(signal) : signal);
    }
    std::vector<float> values;
    values.reserve(level.texels.size());
    for (std::size_t i = 0; i < level.texels.size(); ++i)
        values.push_back(i % 4 == 3 ? static_cast<float>(level.texels[i]) / 255 : linear[level.texels[i]]);
    return values;
}

/// The textures of a scene's draws, each made once for each way to look it up.
class SceneTexels {
  public:
    SceneTexels(int most, const SceneImages& images) : most_(most), images_(images) {}

    /// Of one draw, beside those that are given.
    vulkan::Textures of(std::size_t draw, const Interface& interface, vulkan::Textures given) {
        if (reads(interface, "opacityMap")) given["opacityMap"] = alpha_map(draw);
        if (draw < images_.pictures.size())
            for (const auto& [sampler, use] : images_.pictures[draw])
                if (reads(interface, sampler)) given[sampler] = picture(use);
        return given;
    }

    [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

  private:
    /// White but for its alpha.
    vulkan::Texels alpha_map(std::size_t draw) {
        const AlphaMap map = alpha_map_within(most_, images_.opacity, draw, warnings_);
        vulkan::TextureTexels texels;
        texels.width = map.width;
        texels.height = map.height;
        for (const std::uint8_t alpha : map.texels)
            texels.values.insert(texels.values.end(), {1, 1, 1, static_cast<float>(alpha) / 255});
        return std::make_shared<const vulkan::TextureTexels>(std::move(texels));
    }

    vulkan::Texels picture(const PictureUse& use) {
        vulkan::Texels& known =
            pictures_[std::tuple(use.picture, use.is_srgb, use.use->wrap_s, use.use->wrap_t,
                                 use.use->is_nearest, use.use->min_filter)];
        if (known != nullptr) return known;
        const std::vector<TextureImage> levels =
            levels_within(most_, picture_levels(*use.picture, use.is_srgb), warnings_);
        vulkan::TextureTexels texels;
        texels.lookup = lookup_of(*use.use);
        texels.width = levels.front().width;
        texels.height = levels.front().height;
        texels.values = floats_of(levels.front(), use.is_srgb);
        texels.has_levels = use.use->min_filter != GL_NEAREST && use.use->min_filter != GL_LINEAR;
        for (std::size_t i = 1; texels.has_levels && i < levels.size(); ++i)
            texels.smaller.push_back(floats_of(levels[i], use.is_srgb));
        known = std::make_shared<const vulkan::TextureTexels>(std::move(texels));
        return known;
    }

    int most_;
    const SceneImages& images_;
    std::map<std::tuple<const TextureImage*, bool, int, int, bool, int>, vulkan::Texels> pictures_;
    Diagnostics warnings_;
};

}  // namespace

Result<Picture> draw_scene_by_vulkan(const vulkan::Device& device, const Scene& scene,
                                     const SceneShaders& shaders,
                                     const std::vector<RenderValue>& family_values, const SceneView& view,
                                     const VulkanSceneTextures& textures, DriverClock* clock) {
    std::vector<Object> objects = objects_of(scene, shaders);
    const SceneImages images = images_of(scene, shaders.draws);
    const std::vector<RenderValue> values = values_beside_scene(family_values);
    std::vector<std::span<const std::uint32_t>> modules;
    for (const ValidatedStage& stage : shaders.validated.stages) modules.emplace_back(stage.spirv);
    std::vector<vulkan::DrawnBy> permutations;
    for (std::size_t i = 0; i < shaders.interfaces.size(); ++i)
        permutations.push_back({vulkan::modules_of(modules, shaders.composition.permutations[i]),
                                shaders.interfaces[i], values});
    SceneTexels texels(device.largest_texture(), images);
    std::vector<vulkan::Textures> given(objects.size());
    std::vector<vulkan::Draw> with_holes;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto& permutation = shaders.permutation[i];
        if (!permutation) continue;
        given[i] = texels.of(i, shaders.interfaces[*permutation], textures.given);
        if (objects[i].shadow_shape == ShadowShape::with_holes)
            with_holes.push_back({*permutation, objects[i], given[i], false});
    }
    if (textures.pass != nullptr && !images.lights.empty()) {
        const ShadowPlan plan = shadow_plan(images.lights, objects, view.view, textures.pass->side);
        GOBO_TRY(const auto maps,
                 vulkan::draw_shadow_maps(device, *textures.pass, plan, objects, permutations, with_holes));
        const vulkan::Texels depths = vulkan::depth_texels(maps);
        for (std::size_t i = 0; i < objects.size(); ++i) {
            given[i]["shadowMaps"] = depths;
            if (i >= images.shadows.size()) continue;
            const std::vector<RenderValue> own = shadow_values(plan.values, images.shadows[i]);
            objects[i].values.insert(objects[i].values.end(), own.begin(), own.end());
        }
    }
    std::vector<vulkan::Draw> draws;
    for (const std::size_t i : drawing_order(shaders.draws, images, view))
        if (const auto& permutation = shaders.permutation[i])
            draws.push_back(
                {*permutation, objects[i], given[i], i < images.are_blended.size() && images.are_blended[i]});
    const auto begins = [&](std::size_t permutation) {
        if (clock != nullptr) clock->begin(static_cast<int>(permutation));
    };
    GOBO_TRY(Picture picture, vulkan::render_draws(device, permutations, draws, view, view.width, view.height,
                                                   view.background, begins));
    picture.warnings.insert(picture.warnings.end(), texels.warnings().begin(), texels.warnings().end());
    return picture;
}

}  // namespace gobo::scene
