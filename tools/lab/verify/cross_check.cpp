#include "lab/verify/cross_check.hpp"

#include <algorithm>
#include <memory>

#include "lab/render/driver_tasks.hpp"
#include "lab/render/render.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lab/render/texture.hpp"
#include "lab/vulkan/picture.hpp"
#include "spirv/transform.hpp"
#include "validate/validate.hpp"

namespace gobo::verify {
namespace {

/// One permutation as the renderer drew it, and what evaluation needs to do the same.
struct Drawn {
    Interface interface;
    std::vector<RenderValue> values;
    evaluate::Images images;
    Picture picture;
};

/// What draws, in a child process.
class Renderer {
  public:
    Renderer() = default;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    virtual ~Renderer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    virtual Result<Drawn> draw(const Permutation& permutation) = 0;
    virtual Result<std::vector<Image>> draw_maps(const std::vector<ShadowLight>& lights) = 0;
};

std::vector<ShadowLight> shadow_lights_of(const CrossCheckScene& scene, const Key& key) {
    if (scene.family == nullptr || scene.shadow_pass == nullptr) return {};
    return shadow_lights(*scene.family, key);
}

class OpenGlRenderer final : public Renderer {
  public:
    OpenGlRenderer(Context context, const Composition& composition, const Validated& validated,
                   const CrossCheckScene& scene)
        : context_(std::move(context)),
          composition_(composition),
          validated_(validated),
          scene_(scene),
          textures_(context_) {}

    [[nodiscard]] std::string name() const override { return context_.renderer(); }

    Result<Drawn> draw(const Permutation& permutation) override {
        Drawn drawn;
        drawn.interface = interface_of(validated_, permutation);
        drawn.values = scene_.values;
        GOBO_TRY_DO(textures_.add(drawn.interface, scene_.values, scene_.cubes));
        drawn.images = textures_.images();
        GivenTextures given = textures_.given();
        std::optional<ShadowMaps> maps;
        if (const auto lights = shadow_lights_of(scene_, permutation.key); !lights.empty()) {
            GOBO_TRY(auto drawn_maps, maps_of(lights));
            maps.emplace(std::move(drawn_maps));
            given["shadowMaps"] = maps->texture();
            drawn.values.insert(drawn.values.end(), maps->values().begin(), maps->values().end());
            drawn.images["shadowMaps"] = raster::depths_of(*maps, lights);
        }
        drawn.values = raster::with_plain_textures(drawn.interface, std::move(drawn.values));
        GOBO_TRY(drawn.picture,
                 render_permutation(context_, stages_of(composition_, permutation), drawn.interface,
                                    scene_.objects, drawn.values, scene_.view, given));
        return drawn;
    }

    Result<std::vector<Image>> draw_maps(const std::vector<ShadowLight>& lights) override {
        GOBO_TRY(const ShadowMaps maps, maps_of(lights));
        return raster::layers_of(maps, lights);
    }

  private:
    [[nodiscard]] Result<ShadowMaps> maps_of(const std::vector<ShadowLight>& lights) const {
        return draw_shadow_maps(context_, scene_.shadow_pass->pass, lights, scene_.objects,
                                scene_.view.camera.view());
    }

    Context context_;
    const Composition& composition_;
    const Validated& validated_;
    const CrossCheckScene& scene_;
    raster::SharedTextures textures_;
};

class VulkanRenderer final : public Renderer {
  public:
    VulkanRenderer(vulkan::Device device, const Validated& validated, const CrossCheckScene& scene)
        : device_(std::move(device)), validated_(validated), scene_(scene) {
        for (const ValidatedStage& stage : validated.stages) modules_.emplace_back(stage.spirv);
        if (scene.shadow_pass != nullptr) shadow_pass_ = scene.shadow_pass->for_vulkan();
    }

    [[nodiscard]] std::string name() const override { return device_.name(); }

    Result<Drawn> draw(const Permutation& permutation) override {
        Drawn drawn;
        drawn.interface = interface_of(validated_, permutation);
        drawn.values = scene_.values;
        vulkan::Textures given;
        add_textures(drawn, given);
        if (const auto lights = shadow_lights_of(scene_, permutation.key); !lights.empty()) {
            GOBO_TRY(const auto maps, draw_maps(lights));
            const ShadowPlan plan = plan_of(lights);
            given["shadowMaps"] = vulkan::depth_texels(maps);
            drawn.values.insert(drawn.values.end(), plan.values.begin(), plan.values.end());
            drawn.images["shadowMaps"] = raster::depths_of(maps);
        }
        drawn.values = raster::with_plain_textures(drawn.interface, std::move(drawn.values));
        GOBO_TRY(drawn.picture, vulkan::render_permutation(device_, vulkan::modules_of(modules_, permutation),
                                                           drawn.interface, scene_.objects, drawn.values,
                                                           scene_.view, given));
        return drawn;
    }

    Result<std::vector<Image>> draw_maps(const std::vector<ShadowLight>& lights) override {
        return vulkan::draw_shadow_maps(device_, shadow_pass_, plan_of(lights), scene_.objects);
    }

  private:
    [[nodiscard]] ShadowPlan plan_of(const std::vector<ShadowLight>& lights) const {
        return shadow_plan(lights, scene_.objects, scene_.view.camera.view(), shadow_pass_.side);
    }

    /// As SharedTextures has them for OpenGL.
    void add_textures(Drawn& drawn, vulkan::Textures& given) const {
        for (const Sampler& sampler : drawn.interface.samplers) {
            const RenderValue* value = find_value(scene_.values, sampler.name);
            const auto cube = scene_.cubes.find(sampler.name);
            if (!sampler.array.empty()) continue;
            if (cube != scene_.cubes.end() && combined_type(sampler.type) == "samplerCube") {
                given[sampler.name] = vulkan::cube_texels(cube->second);
                drawn.images[sampler.name] = raster::colors_of_cube(cube->second);
            } else if (value != nullptr && !value->source.empty() &&
                       combined_type(sampler.type) == "sampler2D") {
                const TextureSource source{value->source, value->numbers};
                const auto texels = vulkan::usual_texels(sampler.type, source, TextureLevels::one);
                if (texels == nullptr) continue;
                given[sampler.name] = texels;
                drawn.images[sampler.name] = raster::colors_of_picture(texture_texels(source));
            }
        }
    }

    vulkan::Device device_;
    const Validated& validated_;
    const CrossCheckScene& scene_;
    std::vector<std::span<const std::uint32_t>> modules_;
    vulkan::ShadowPass shadow_pass_;
};

/// A stage's SPIR-V as a pipeline makes it for the permutation.
Result<SpirvModule> module_of(const Validated& validated, const Permutation& permutation, StageKind kind) {
    const SpirvModule& words = validated.stage(permutation.stages[kind]).spirv;
    if (permutation.specialized.empty()) return words;
    std::map<int, std::uint32_t> values;
    for (const SpecializedCount& count : permutation.specialized)
        values[count.id] = static_cast<std::uint32_t>(count.value);
    return spirv::specialized(words, values);
}

Result<raster::PictureReport> compare(const Drawn& drawn, const SpirvModule& vertex,
                                      const SpirvModule& fragment, const CrossCheckScene& scene,
                                      raster::ClipSpace clip_space) {
    GOBO_TRY(const auto pipeline, raster::pipeline_of(vertex, fragment));
    GOBO_TRY(const auto objects,
             raster::rasterise_objects(pipeline, drawn.interface, scene.objects, drawn.values, scene.view,
                                       drawn.images, clip_space));
    return raster::compare_picture(drawn.picture, pipeline, objects, scene.view.background);
}

/// The picture is right where all of it agrees with one of the ways in which a driver may take derivatives.
Result<raster::PictureReport> compare(const Validated& validated, const Permutation& permutation,
                                      const Drawn& drawn, const CrossCheckScene& scene,
                                      raster::ClipSpace clip_space) {
    GOBO_TRY(const SpirvModule vertex, module_of(validated, permutation, StageKind::vertex));
    GOBO_TRY(const SpirvModule fragment, module_of(validated, permutation, StageKind::fragment));
    const SpirvModule fine = raster::with_derivatives(fragment, raster::Derivatives::fine);
    GOBO_TRY(auto report, compare(drawn, vertex, fine, scene, clip_space));
    const SpirvModule coarse = raster::with_derivatives(fragment, raster::Derivatives::coarse);
    if (!report.fails() || coarse == fine) return report;
    GOBO_TRY(auto other, compare(drawn, vertex, coarse, scene, clip_space));
    return other.fails() ? report : other;
}

/// Every light that casts shadows in any of the keys: of each kind, as many as in the key that has most.
std::vector<ShadowLight> all_lights(const Composition& composition, const CrossCheckScene& scene) {
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
    return lights;
}

/// The maps of all of them.
Result<ShadowMapReport> compare_maps(Renderer& renderer, const std::vector<ShadowLight>& lights,
                                     const CrossCheckScene& scene, DriverClock& clock) {
    GOBO_TRY(const auto maps, renderer.draw_maps(lights));
    clock.stop();
    const ShadowPlan plan =
        shadow_plan(lights, scene.objects, scene.view.camera.view(), scene.shadow_pass->pass.side);
    return compare_shadow_maps(maps, *scene.shadow_pass, plan.cameras, scene.objects);
}

/// What a child process found out: of a picture, or of the maps.
struct Compared {
    raster::PictureReport picture;
    ShadowMapReport maps;
    std::string renderer;
};
GOBO_FIELDS(Compared, picture, maps, renderer)

}  // namespace

Result<CrossCheckReport> cross_check(const std::string& driver, std::optional<Backend> opengl,
                                     const Composition& composition, const Validated& validated,
                                     const CrossCheckScene& scene, int jobs) {
    const std::vector<Permutation>& permutations = composition.permutations;
    const std::vector<ShadowLight> lights = all_lights(composition, scene);
    CrossCheckReport report;
    report.pictures.resize(permutations.size());
    DriverTasks<std::unique_ptr<Renderer>, Compared> tasks{driver, permutations.size(), jobs};
    if (!lights.empty()) {  // behind the permutations stands one task more: all the maps
        report.shadow_maps.emplace();
        ++tasks.count;
    }
    tasks.open = [&]() -> Result<std::unique_ptr<Renderer>> {
        if (!opengl) {
            GOBO_TRY(vulkan::Device device, vulkan::open_device());
            return std::make_unique<VulkanRenderer>(std::move(device), validated, scene);
        }
        GOBO_TRY(Context context, open_context(*opengl));
        return std::make_unique<OpenGlRenderer>(std::move(context), composition, validated, scene);
    };
    tasks.work = [&](const std::unique_ptr<Renderer>& renderer, std::size_t i,
                     DriverClock& clock) -> Result<Compared> {
        Compared compared;
        compared.renderer = renderer->name();
        if (i == permutations.size()) {
            GOBO_TRY(compared.maps, compare_maps(*renderer, lights, scene, clock));
            return compared;
        }
        GOBO_TRY(Drawn drawn, renderer->draw(permutations[i]));
        clock.stop();
        GOBO_TRY(compared.picture, compare(validated, permutations[i], drawn, scene,
                                           opengl ? raster::ClipSpace::opengl : raster::ClipSpace::vulkan));
        compared.picture.warnings = std::move(drawn.picture.warnings);
        return compared;
    };
    tasks.done = [&](std::size_t i, Result<Compared> compared, std::optional<int> death) {
        if (compared) report.renderer = compared->renderer;
        if (i == permutations.size()) {
            if (compared)
                report.shadow_maps = std::move(compared->maps);
            else
                report.shadow_maps->diagnostics = std::move(compared).error();
            return;
        }
        if (compared)
            report.pictures[i] = std::move(compared->picture);
        else
            report.pictures[i].diagnostics = std::move(compared).error();
        report.pictures[i].key = permutations[i].key;
        if (death) report.crashed.push_back(i);
    };
    GOBO_TRY_DO(ask_driver(tasks));
    std::ranges::sort(report.crashed);
    return report;
}

}  // namespace gobo::verify
