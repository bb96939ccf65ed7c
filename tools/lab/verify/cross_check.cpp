#include "lab/verify/cross_check.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

#include "lab/render/render.hpp"
#include "lab/render/shadow_maps.hpp"
#include "validate/validate.hpp"

namespace gobo::verify {
namespace {

/// One permutation as the renderer drew it, and what evaluation needs to do the same.
struct Drawn {
    Interface interface;
    std::vector<RenderValue> values;
    evaluate::Images images;
    Image color;
};

std::vector<ShadowLight> shadow_lights_of(const CrossCheckScene& scene, const Key& key) {
    if (scene.family == nullptr || scene.shadow_pass == nullptr) return {};
    return shadow_lights(*scene.family, key);
}

Result<ShadowMaps> draw_maps(const Context& context, const CrossCheckScene& scene,
                             const std::vector<ShadowLight>& lights) {
    return draw_shadow_maps(context, scene.shadow_pass->pass, lights, scene.objects,
                            scene.view.camera.view());
}

/// By one thread, as a context wants it.
Result<Drawn> draw(const Context& context, const Composition& composition, const Validated& validated,
                   const Permutation& permutation, const CrossCheckScene& scene,
                   raster::SharedTextures& textures) {
    Drawn drawn;
    drawn.interface = interface_of(validated, permutation);
    drawn.values = scene.values;
    GOBO_TRY_DO(textures.add(drawn.interface, scene.values, scene.cubes));
    drawn.images = textures.images();
    GivenTextures given = textures.given();
    std::optional<ShadowMaps> maps;
    if (const auto lights = shadow_lights_of(scene, permutation.key); !lights.empty()) {
        GOBO_TRY(auto drawn_maps, draw_maps(context, scene, lights));
        maps.emplace(std::move(drawn_maps));
        given["shadowMaps"] = maps->texture();
        drawn.values.insert(drawn.values.end(), maps->values().begin(), maps->values().end());
        drawn.images["shadowMaps"] = raster::depths_of(*maps, lights);
    }
    drawn.values = raster::with_plain_textures(drawn.interface, std::move(drawn.values));
    GOBO_TRY(auto picture, render_permutation(context, stages_of(composition, permutation), drawn.interface,
                                              scene.objects, drawn.values, scene.view, given));
    drawn.color = std::move(picture.color);
    return drawn;
}

Result<raster::PictureReport> compare(const Validated& validated, const Permutation& permutation,
                                      const Result<Drawn>& maybe_drawn, const CrossCheckScene& scene) {
    GOBO_TRY(const Drawn& drawn, maybe_drawn);
    const auto spirv_of = [&](int stage) -> const SpirvModule& {
        return validated.stages[static_cast<std::size_t>(stage)].spirv;
    };
    GOBO_TRY(const auto pipeline, raster::pipeline_of(spirv_of(permutation.stages[StageKind::vertex]),
                                                      spirv_of(permutation.stages[StageKind::fragment])));
    GOBO_TRY(const auto objects, raster::rasterise_objects(pipeline, drawn.interface, scene.objects,
                                                           drawn.values, scene.view, drawn.images));
    return raster::compare_picture(drawn.color, pipeline, objects, scene.view.background);
}

/// The maps of every light that casts shadows in any of the keys: of each kind, as many as in the key that
/// has most.
std::optional<ShadowMapReport> compare_maps(const Context& context, const Composition& composition,
                                            const CrossCheckScene& scene) {
    std::vector<ShadowLight> lights;
    for (const auto kind :
         {ShadowLight::Kind::directional, ShadowLight::Kind::spot, ShadowLight::Kind::point}) {
        std::vector<ShadowLight> most;
        for (const Permutation& permutation : composition.permutations) {
            std::vector<ShadowLight> own = shadow_lights_of(scene, permutation.key);
            std::erase_if(own, [&](const ShadowLight& light) { return light.kind != kind; });
            if (own.size() > most.size()) most = std::move(own);
        }
        lights.insert(lights.end(), most.begin(), most.end());
    }
    if (lights.empty()) return std::nullopt;
    const auto maps = draw_maps(context, scene, lights);
    if (!maps) {
        ShadowMapReport report;
        report.diagnostics = maps.error();
        return report;
    }
    const ShadowPlan plan =
        shadow_plan(lights, scene.objects, scene.view.camera.view(), scene.shadow_pass->pass.side);
    return compare_shadow_maps(*maps, *scene.shadow_pass, plan.cameras, scene.objects);
}

}  // namespace

CrossCheckReport cross_check(const Context& context, const Composition& composition,
                             const Validated& validated, const CrossCheckScene& scene, int jobs) {
    const std::vector<Permutation>& permutations = composition.permutations;
    CrossCheckReport report;
    report.pictures.resize(permutations.size());
    report.shadow_maps = compare_maps(context, composition, scene);
    std::vector<Result<Drawn>> drawn(permutations.size());
    std::atomic<std::size_t> ready = 0;
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < permutations.size(); i = next++) {
            for (std::size_t now = ready; now <= i; now = ready) ready.wait(now);
            raster::PictureReport& picture = report.pictures[i];
            if (Result<raster::PictureReport> found = compare(validated, permutations[i], drawn[i], scene))
                picture = *std::move(found);
            else
                picture.diagnostics = std::move(found).error();
            picture.key = permutations[i].key;
            drawn[i] = Drawn{};
        }
    };
    std::vector<std::jthread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
    raster::SharedTextures textures(context);
    for (std::size_t i = 0; i < permutations.size(); ++i) {
        drawn[i] = draw(context, composition, validated, permutations[i], scene, textures);
        ready = i + 1;
        ready.notify_all();
    }
    threads.clear();  // joins
    return report;
}

}  // namespace gobo::verify
