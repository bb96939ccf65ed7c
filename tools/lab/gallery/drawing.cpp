#include "lab/gallery/drawing.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "lab/render/shadow_maps.hpp"
#include "lab/render/texture.hpp"
#include "lab/verify/witness_textures.hpp"

namespace gobo::gallery {
namespace {

/// The values, and for each sampler2D that they leave out the texture that the renderer would take.
std::vector<RenderValue> with_usual_textures(const Interface& interface, std::vector<RenderValue> values) {
    for (const Sampler& sampler : interface.samplers) {
        const bool is_given = find_value(values, sampler.name) != nullptr;
        if (is_given || sampler.type != "sampler2D" || !sampler.array.empty()) continue;
        TextureSource source = texture_source_of(sampler.name, values);
        values.push_back({sampler.name, std::move(source.name), std::move(source.numbers), {}});
    }
    return values;
}

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
    drawing.values = with_usual_textures(interface, family.render);
    verify::WitnessTextures textures(context);
    if (const auto added = textures.add(interface, drawing.values, scene.cube_maps); !added)
        return tl::unexpected(added.error());
    drawing.images = textures.images();
    GivenTextures given = textures.given();
    std::optional<Result<ShadowMaps>> maps;
    const std::vector<ShadowLight> lights = shadow_lights(family, permutation.key);
    if (!lights.empty() && !scene.depth_pass.stages.empty()) {
        maps.emplace(
            draw_shadow_maps(context, scene.depth_pass, lights, scene.objects, scene.view.camera.view()));
        if (!*maps) return tl::unexpected(maps->error());
        const std::vector<RenderValue>& values = (*maps)->values();
        drawing.values.insert(drawing.values.end(), values.begin(), values.end());
        drawing.images["shadowMaps"] = verify::depths_of(**maps, lights);
        given["shadowMaps"] = (*maps)->texture();
    }
    auto picture = render_permutation(
        context, {stage_text(composition, permutation.vertex), stage_text(composition, permutation.fragment)},
        interface, scene.objects, drawing.values, scene.view, given);
    if (!picture) return tl::unexpected(picture.error());
    drawing.color = std::move(picture->color);
    drawing.warnings = std::move(picture->warnings);
    return drawing;
}

}  // namespace gobo::gallery
