#include "lab/gallery/picture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "lab/raster/raster_object.hpp"
#include "lab/raster/shade.hpp"
#include "lab/raster/shared_textures.hpp"

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
    return {.position = {0, 2.8, 4.3}, .target = {0, -0.14, 0}, .field_of_view = 0.5, .far_plane = 50};
}

Result<Drawing> draw(const Context& context, const Scene& scene, const Family& family,
                     const Composition& composition, const Validated& validated,
                     const Permutation& permutation) {
    Drawing drawing;
    drawing.interface = interface_of(validated, permutation);
    drawing.values = with_usual_textures(drawing.interface, family.render);
    raster::SharedTextures textures(context);
    GOBO_TRY_DO(textures.add(drawing.interface, drawing.values, scene.cube_maps));
    drawing.images = textures.images();
    GivenTextures given = textures.given();
    std::optional<ShadowMaps> maps;
    const std::vector<ShadowLight> lights = shadow_lights(family, permutation.key);
    if (!lights.empty() && !scene.depth_pass.stages.empty()) {
        GOBO_TRY(ShadowMaps drawn, draw_shadow_maps(context, scene.depth_pass, lights, scene.objects,
                                                    scene.view.camera.view()));
        maps.emplace(std::move(drawn));
        drawing.values.insert(drawing.values.end(), maps->values().begin(), maps->values().end());
        drawing.images["shadowMaps"] = raster::depths_of(*maps, lights);
        given["shadowMaps"] = maps->texture();
    }
    GOBO_TRY(Picture picture,
             render_permutation(context, stages_of(composition, permutation), drawing.interface,
                                scene.objects, drawing.values, scene.view, given));
    drawing.color = std::move(picture.color);
    drawing.warnings = std::move(picture.warnings);
    return drawing;
}

Result<Evaluation> evaluate_drawing(const Drawing& drawing, const Scene& scene, const Validated& validated,
                                    const Permutation& permutation, const study::Weights& weights) {
    const auto spirv = [&](int stage) -> const SpirvModule& {
        return validated.stages[static_cast<std::size_t>(stage)].spirv;
    };
    GOBO_TRY(const raster::Pipeline program,
             raster::pipeline_of(spirv(permutation.vertex), spirv(permutation.fragment)));
    const auto objects_in = [&](const View& view) {
        return raster::rasterise_objects(program, drawing.interface, scene.objects,
                                         raster::with_plain_textures(drawing.interface, drawing.values), view,
                                         drawing.images);
    };
    GOBO_TRY(const auto seen, objects_in(scene.view));
    Evaluation evaluation;
    evaluation.report = raster::compare_picture(drawing.color, program, seen, scene.view.background,
                                                raster::KeptPictures::all);
    if (!evaluation.report.diagnostics.empty()) return tl::unexpected(evaluation.report.diagnostics);

    // Costs are averages: a picture this small tells them to a few parts in a hundred.
    View small = scene.view;
    small.width = 80;
    small.height = 60;
    GOBO_TRY(const auto objects, objects_in(small));
    raster::Work work;
    std::size_t fragments = 0;
    std::size_t vertices = 0;
    for (const raster::RasterObject& object : objects) {
        GOBO_TRY(const auto shaded, raster::shade<float>(program, object, &work));
        fragments += shaded.size();
        vertices += shaded.empty() ? 0 : object.positions.size();
    }
    const auto each = [](double all, std::size_t count) {
        return all / static_cast<double>(std::max<std::size_t>(count, 1));
    };
    evaluation.fragment_cost = each(study::weighted(work.fragments, weights), fragments);
    evaluation.vertex_cost = each(study::weighted(work.vertices, weights), vertices);
    return evaluation;
}

float exposure_of(const Image& picture) {
    constexpr float kWhite = 0.95F;  // leaves the brightest hundredth room above it
    std::vector<float> brightness;   // the largest colour that is not infinite, of each pixel
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            float& largest = brightness.emplace_back(0.0F);
            for (int channel = 0; channel < std::min(picture.channels, 3); ++channel)
                if (std::isfinite(picture.at(x, y, channel)))
                    largest = std::max(largest, picture.at(x, y, channel));
        }
    }
    if (brightness.empty()) return 1;
    const auto place = brightness.begin() + static_cast<std::ptrdiff_t>(brightness.size() / 100);
    std::nth_element(brightness.begin(), place, brightness.end(), std::greater<>());
    return *place > kWhite ? kWhite / *place : 1;
}

Image exposed(Image picture, float exposure) {
    const auto channels = static_cast<std::size_t>(picture.channels);
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        if (channels < 4 || i % channels < 3) picture.values[i] *= exposure;
    return picture;
}

}  // namespace gobo::gallery
