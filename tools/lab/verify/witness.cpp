#include "lab/verify/witness.hpp"

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
    Result<Image> color = Image();
};

std::vector<ShadowLight> shadow_lights_of(const WitnessScene& scene, const Key& key) {
    if (scene.family == nullptr || scene.shadow_pass == nullptr) return {};
    return shadow_lights(*scene.family, key);
}

Result<ShadowMaps> draw_maps(const Context& context, const WitnessScene& scene,
                             const std::vector<ShadowLight>& lights) {
    return draw_shadow_maps(context, scene.shadow_pass->pass, lights, scene.objects,
                            scene.view.camera.view());
}

/// Draws one permutation after the other, as a context wants it: by one thread.
class Drawer {
  public:
    Drawer(const Context& context, const Composition& composition, const Validated& validated,
           const WitnessScene& scene)
        : context_(context),
          composition_(composition),
          validated_(validated),
          scene_(scene),
          textures_(context) {}

    Drawn draw(const Permutation& permutation) {
        Drawn drawn;
        drawn.interface = interface_of(validated_, permutation);
        drawn.values = scene_.values;
        if (auto added = textures_.add(drawn.interface, scene_.values, scene_.cubes); !added) {
            drawn.color = tl::unexpected(added.error());
            return drawn;
        }
        drawn.images = textures_.images();
        GivenTextures given = textures_.given();
        std::optional<Result<ShadowMaps>> maps;
        if (const auto lights = shadow_lights_of(scene_, permutation.key); !lights.empty()) {
            maps.emplace(draw_maps(context_, scene_, lights));
            if (!*maps) {
                drawn.color = tl::unexpected(maps->error());
                return drawn;
            }
            given["shadowMaps"] = (*maps)->texture();
            drawn.values.insert(drawn.values.end(), (*maps)->values().begin(), (*maps)->values().end());
            drawn.images["shadowMaps"] = depths_of(**maps, lights);
        }
        drawn.values = with_plain_textures(drawn.interface, std::move(drawn.values));
        drawn.color = picture(permutation, drawn, given);
        return drawn;
    }

  private:
    Result<Image> picture(const Permutation& permutation, const Drawn& drawn, const GivenTextures& given) {
        auto picture = render_permutation(
            context_,
            {stage_text(composition_, permutation.vertex), stage_text(composition_, permutation.fragment)},
            drawn.interface, scene_.objects, drawn.values, scene_.view, given);
        if (!picture) return tl::unexpected(picture.error());
        return std::move(picture->color);
    }

    const Context& context_;
    const Composition& composition_;
    const Validated& validated_;
    const WitnessScene& scene_;
    WitnessTextures textures_;
};

PictureReport without_picture(Diagnostics why) {
    PictureReport report;
    report.diagnostics = std::move(why);
    return report;
}

PictureReport compare(const Validated& validated, const Permutation& permutation, const Drawn& drawn,
                      const WitnessScene& scene) {
    if (!drawn.color) return without_picture(drawn.color.error());
    const auto spirv_of = [&](int stage) -> const SpirvModule& {
        return validated.stages[static_cast<std::size_t>(stage)].spirv;
    };
    const auto program = software_program(spirv_of(permutation.vertex), spirv_of(permutation.fragment));
    if (!program) return without_picture(program.error());
    const auto objects =
        rasterise_objects(*program, drawn.interface, scene.objects, drawn.values, scene.view, drawn.images);
    if (!objects) return without_picture(objects.error());
    return compare_picture(*drawn.color, *program, *objects, scene.view.background);
}

/// The maps of every light that casts shadows in any of the keys: of each kind, as many as in the key that
/// has most.
std::optional<ShadowMapReport> compare_maps(const Context& context, const Composition& composition,
                                            const WitnessScene& scene) {
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

WitnessReport witness(const Context& context, const Composition& composition, const Validated& validated,
                      const WitnessScene& scene, int jobs) {
    const std::vector<Permutation>& permutations = composition.permutations;
    WitnessReport report;
    report.pictures.resize(permutations.size());
    report.shadow_maps = compare_maps(context, composition, scene);
    std::vector<Drawn> drawn(permutations.size());
    std::atomic<std::size_t> ready = 0;
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < permutations.size(); i = next++) {
            for (std::size_t now = ready; now <= i; now = ready) ready.wait(now);
            report.pictures[i] = compare(validated, permutations[i], drawn[i], scene);
            report.pictures[i].key = permutations[i].key;
            drawn[i] = {};
        }
    };
    std::vector<std::jthread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
    Drawer drawer(context, composition, validated, scene);
    for (std::size_t i = 0; i < permutations.size(); ++i) {
        drawn[i] = drawer.draw(permutations[i]);
        ready = i + 1;
        ready.notify_all();
    }
    threads.clear();  // joins
    return report;
}

}  // namespace gobo::verify
