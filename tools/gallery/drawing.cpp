#include "gallery/drawing.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "evaluate/color_texels.hpp"
#include "evaluate/images.hpp"
#include "render/cube_maps.hpp"
#include "render/lit_shadows.hpp"

namespace gobo::gallery {
namespace {

/// The depths of all layers, read back.
evaluate::Image depths_of(const ShadowMaps& maps, int side, int layers) {
    const auto texels = std::make_shared<evaluate::DepthTexels>();
    texels->width = texels->height = side;
    texels->layers = layers;
    for (int layer = 0; layer < layers; ++layer) {
        const Image depths = maps.layer(layer);
        texels->depths.insert(texels->depths.end(), depths.values.begin(), depths.values.end());
    }
    return [texels](const evaluate::ImageRequest& request) { return evaluate::answer(*texels, request); };
}

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

evaluate::Image cube_of(const Image& faces) {
    const auto texels =
        std::make_shared<evaluate::CubeTexels>(evaluate::CubeTexels{faces.width, colors_of(faces)});
    return [texels](const evaluate::ImageRequest& request) { return evaluate::answer(*texels, request); };
}

evaluate::Image flat_of(const Image& image) {
    const auto texels = std::make_shared<evaluate::ColorTexels>(
        evaluate::ColorTexels{image.width, image.height, colors_of(image)});
    return [texels](const evaluate::ImageRequest& request) { return evaluate::answer(*texels, request); };
}

/// Gathers the textures of one permutation and deletes them.
class Textures {
  public:
    explicit Textures(const Context& context) : resources_(context), cube_maps_(context) {}

    /// A texture of one level for each sampler2D; those of other types are the renderer's own.
    Result<void> add(const Interface& interface, const Scene& scene, Drawing& drawing) {
        for (const Sampler& sampler : interface.samplers) {
            if (const auto cube = scene.cube_maps.find(sampler.name); cube != scene.cube_maps.end()) {
                if (const auto added = cube_maps_.add(sampler.name, cube->second); !added) return added;
                drawing.images[sampler.name] = cube_of(cube->second);
            } else if (sampler.type == "sampler2D" && sampler.array.empty()) {
                add_flat(sampler, drawing);
            }
        }
        given_.insert(cube_maps_.textures().begin(), cube_maps_.textures().end());
        return {};
    }
    void add(const std::string& sampler, const Texture& texture) { given_[sampler] = texture; }
    [[nodiscard]] const GivenTextures& given() const { return given_; }

  private:
    void add_flat(const Sampler& sampler, Drawing& drawing) {
        const TextureSource source = texture_source_of(sampler.name, drawing.values);
        const auto texture = make_texture(resources_.context(), sampler.type, source, TextureLevels::one);
        if (!texture) return;
        resources_.adopt(*texture);
        given_[sampler.name] = *texture;
        drawing.images[sampler.name] = flat_of(texture_texels(source));
    }

    GlResources resources_;
    CubeMaps cube_maps_;
    GivenTextures given_;
};

}  // namespace

Camera gallery_camera() {
    Camera camera;
    camera.position = {0, 2.8, 4.3};
    camera.target = {0, -0.14, 0};
    camera.field_of_view = 0.5;
    camera.far_plane = 50;
    return camera;
}

Result<Drawing> draw(const Context& context, const Scene& scene, const Family& family,
                     const Composition& composition, const Permutation& permutation,
                     const Interface& interface) {
    Drawing drawing;
    drawing.values = family.render;
    Textures textures(context);
    std::optional<Result<ShadowMaps>> maps;
    const std::vector<ShadowLight> lights = shadow_lights(family, permutation.key);
    if (!lights.empty() && !scene.depth_pass.stages.empty()) {
        const glm::dmat4 view = scene.view.camera.view();
        maps.emplace(draw_shadow_maps(context, scene.depth_pass, lights, scene.objects, view));
        if (!*maps) return tl::unexpected(maps->error());
        const std::vector<RenderValue>& values = (*maps)->values();
        drawing.values.insert(drawing.values.end(), values.begin(), values.end());
        const ShadowPlan plan = shadow_plan(lights, scene.objects, view, scene.depth_pass.side);
        drawing.images["shadowMaps"] =
            depths_of(**maps, scene.depth_pass.side, static_cast<int>(plan.cameras.size()));
        textures.add("shadowMaps", (*maps)->texture());
    }
    if (const auto added = textures.add(interface, scene, drawing); !added)
        return tl::unexpected(added.error());
    auto picture = render_permutation(
        context, {stage_text(composition, permutation.vertex), stage_text(composition, permutation.fragment)},
        interface, scene.objects, drawing.values, scene.view, textures.given());
    if (!picture) return tl::unexpected(picture.error());
    drawing.color = std::move(picture->color);
    drawing.warnings = std::move(picture->warnings);
    return drawing;
}

}  // namespace gobo::gallery
