#include "lab/verify/cross_check.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

#include "core/bytes.hpp"
#include "core/child_processes.hpp"
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

/// What draws; used by one thread.
class Renderer {
  public:
    Renderer() = default;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    virtual ~Renderer() = default;
    virtual Result<Drawn> draw(const Permutation& permutation) = 0;
    virtual Result<std::vector<Image>> draw_maps(const std::vector<ShadowLight>& lights) = 0;
};

std::vector<ShadowLight> shadow_lights_of(const CrossCheckScene& scene, const Key& key) {
    if (scene.family == nullptr || scene.shadow_pass == nullptr) return {};
    return shadow_lights(*scene.family, key);
}

class OpenGlRenderer final : public Renderer {
  public:
    OpenGlRenderer(const Context& context, const Composition& composition, const Validated& validated,
                   const CrossCheckScene& scene)
        : context_(context),
          composition_(composition),
          validated_(validated),
          scene_(scene),
          textures_(context) {}

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
        int count = 0;
        for (const ShadowLight& light : lights) count += light.kind == ShadowLight::Kind::point ? 6 : 1;
        std::vector<Image> layers;
        for (int i = 0; i < count; ++i) layers.push_back(maps.layer(i));
        return layers;
    }

  private:
    [[nodiscard]] Result<ShadowMaps> maps_of(const std::vector<ShadowLight>& lights) const {
        return draw_shadow_maps(context_, scene_.shadow_pass->pass, lights, scene_.objects,
                                scene_.view.camera.view());
    }

    const Context& context_;
    const Composition& composition_;
    const Validated& validated_;
    const CrossCheckScene& scene_;
    raster::SharedTextures textures_;
};

/// What a child process sends of one task: a picture or layers of depths, or why there are none.
struct Drawing {
    std::vector<float> color;
    std::vector<float> depth;
    std::vector<float> depths;  ///< of all layers
    std::string renderer;
    Diagnostics warnings;
    Diagnostics errors;
};

void fields(auto& archive, OneOf<Drawing> auto& value) {
    auto& [color, depth, depths, renderer, warnings, errors] = value;
    archive(color, depth, depths, renderer, warnings, errors);
}

/// Draws everything in child processes before there are threads, and answers from what they sent.
class VulkanRenderer final : public Renderer {
  public:
    VulkanRenderer(const Composition& composition, const Validated& validated, const CrossCheckScene& scene)
        : composition_(composition), validated_(validated), scene_(scene) {
        for (const ValidatedStage& stage : validated.stages) modules_.emplace_back(stage.spirv);
        if (scene.shadow_pass == nullptr) return;
        const ShadowPass& pass = *scene.shadow_pass;
        shadow_pass_ = {{{StageKind::vertex, pass.vertex, {}}, {StageKind::fragment, pass.fragment, {}}},
                        pass.pass.interface,
                        pass.pass.values,
                        pass.pass.side,
                        pass.pass.slope,
                        pass.pass.units};
    }

    /// Behind the permutations stands one task more: the maps of `lights`. Fault::file where there is no
    /// device.
    Result<void> draw_all(const std::vector<ShadowLight>& lights, int jobs) {
        drawings_.resize(composition_.permutations.size() + 1);
        std::optional<vulkan::Device> device;  // each child's own
        ChildWork work;
        work.work = [&](std::size_t task, Note&) {
            Result<Drawing> drawing = drawn_by_child(device, task, lights);
            if (drawing) return to_bytes(*drawing);
            Drawing failed;
            failed.errors = std::move(drawing).error();
            return to_bytes(failed);
        };
        work.done = [&](std::size_t task, std::string_view bytes) {
            drawings_[task] = from_bytes<Drawing>(bytes);
            return drawings_[task].has_value();
        };
        work.died = [&](std::size_t task, int, Death) {
            Drawing& dead = drawings_[task].emplace();
            dead.errors = fail(Fault::input, "the Vulkan driver dies when it draws this").value();
            crashed_.push_back(task);
            return false;
        };
        const std::vector<std::size_t> left = run_in_children(
            jobs, drawings_.size(), work, {.processor_seconds = kSeconds, .memory = 0, .writes_files = true});
        if (!left.empty())
            return fail(Fault::file, "no child process can be started, in which Vulkan would draw");
        std::ranges::sort(crashed_);
        for (const std::optional<Drawing>& drawing : drawings_)
            if (exit_status(drawing->errors) == 3) return tl::unexpected(drawing->errors);
        return {};
    }

    [[nodiscard]] std::string name() const {
        for (const std::optional<Drawing>& drawing : drawings_)
            if (!drawing->renderer.empty()) return drawing->renderer;
        return "no driver";
    }
    [[nodiscard]] const std::vector<std::size_t>& crashed() const { return crashed_; }

    Result<Drawn> draw(const Permutation& permutation) override {
        const Drawing& drawing = *drawings_[number_of(permutation)];
        if (!drawing.errors.empty()) return tl::unexpected(drawing.errors);
        GOBO_TRY(Drawn drawn, described(permutation, images_of(drawing.depths), nullptr));
        drawn.picture = {Image(scene_.view.width, scene_.view.height, 4),
                         Image(scene_.view.width, scene_.view.height, 1), drawing.warnings};
        drawn.picture.color.values = drawing.color;
        drawn.picture.depth.values = drawing.depth;
        return drawn;
    }

    Result<std::vector<Image>> draw_maps(const std::vector<ShadowLight>&) override {
        const Drawing& drawing = *drawings_.back();
        if (!drawing.errors.empty()) return tl::unexpected(drawing.errors);
        return images_of(drawing.depths);
    }

  private:
    static constexpr int kSeconds = 120;

    [[nodiscard]] std::size_t number_of(const Permutation& permutation) const {
        return static_cast<std::size_t>(&permutation - composition_.permutations.data());
    }

    Result<Drawing> drawn_by_child(std::optional<vulkan::Device>& device, std::size_t task,
                                   const std::vector<ShadowLight>& lights) const {
        if (!device) {
            GOBO_TRY(device, vulkan::open_device());
        }
        Drawing drawing;
        drawing.renderer = device->name();
        const bool are_maps = task == composition_.permutations.size();
        const std::vector<ShadowLight> own =
            are_maps ? lights : shadow_lights_of(scene_, composition_.permutations[task].key);
        std::vector<Image> maps;
        if (!own.empty()) {
            GOBO_TRY(maps, vulkan::draw_shadow_maps(*device, shadow_pass_, plan_of(own), scene_.objects));
        }
        for (const Image& map : maps)
            drawing.depths.insert(drawing.depths.end(), map.values.begin(), map.values.end());
        if (are_maps) return drawing;
        const Permutation& permutation = composition_.permutations[task];
        vulkan::Textures given;
        GOBO_TRY(const Drawn drawn, described(permutation, maps, &given));
        GOBO_TRY(auto picture, vulkan::render_permutation(*device, vulkan::modules_of(modules_, permutation),
                                                          drawn.interface, scene_.objects, drawn.values,
                                                          scene_.view, given));
        drawing.color = std::move(picture.color.values);
        drawing.depth = std::move(picture.depth.values);
        drawing.warnings = std::move(picture.warnings);
        return drawing;
    }

    /// All but the picture; `given` becomes the textures where somebody draws.
    Result<Drawn> described(const Permutation& permutation, const std::vector<Image>& maps,
                            vulkan::Textures* given) const {
        Drawn drawn;
        drawn.interface = interface_of(validated_, permutation);
        drawn.values = scene_.values;
        vulkan::Textures textures;
        add_textures(drawn, textures);
        if (!maps.empty()) {
            const ShadowPlan plan = plan_of(shadow_lights_of(scene_, permutation.key));
            textures["shadowMaps"] = vulkan::depth_texels(maps);
            drawn.values.insert(drawn.values.end(), plan.values.begin(), plan.values.end());
            drawn.images["shadowMaps"] = raster::depths_of(maps);
        }
        drawn.values = raster::with_plain_textures(drawn.interface, std::move(drawn.values));
        if (given != nullptr) *given = std::move(textures);
        return drawn;
    }

    [[nodiscard]] ShadowPlan plan_of(const std::vector<ShadowLight>& lights) const {
        return shadow_plan(lights, scene_.objects, scene_.view.camera.view(), shadow_pass_.side);
    }

    [[nodiscard]] std::vector<Image> images_of(const std::vector<float>& depths) const {
        const int side = shadow_pass_.side;
        const auto size = static_cast<std::ptrdiff_t>(side) * side;
        std::vector<Image> layers;
        for (auto at = depths.begin(); at != depths.end(); at += size) {
            Image& layer = layers.emplace_back(side, side, 1);
            std::copy(at, at + size, layer.values.begin());
        }
        return layers;
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
                if (!texels) continue;
                given[sampler.name] = *texels;
                drawn.images[sampler.name] = raster::colors_of_picture(texture_texels(source));
            }
        }
    }

    const Composition& composition_;
    const Validated& validated_;
    const CrossCheckScene& scene_;
    std::vector<std::span<const std::uint32_t>> modules_;
    vulkan::ShadowPass shadow_pass_;
    std::vector<std::optional<Drawing>> drawings_;  ///< by permutation, then that of all maps
    std::vector<std::size_t> crashed_;
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
                                      bool rows_run_down) {
    GOBO_TRY(const auto pipeline, raster::pipeline_of(vertex, fragment));
    GOBO_TRY(auto objects, raster::rasterise_objects(pipeline, drawn.interface, scene.objects, drawn.values,
                                                     scene.view, drawn.images));
    for (raster::RasterObject& object : objects) object.rows_run_down = rows_run_down;
    return raster::compare_picture(drawn.picture, pipeline, objects, scene.view.background);
}

/// The picture is right where all of it agrees with one of the ways in which a driver may take derivatives.
Result<raster::PictureReport> compare(const Validated& validated, const Permutation& permutation,
                                      const Result<Drawn>& maybe_drawn, const CrossCheckScene& scene,
                                      bool rows_run_down) {
    GOBO_TRY(const Drawn& drawn, maybe_drawn);
    GOBO_TRY(const SpirvModule vertex, module_of(validated, permutation, StageKind::vertex));
    GOBO_TRY(const SpirvModule fragment, module_of(validated, permutation, StageKind::fragment));
    const SpirvModule fine = raster::with_derivatives(fragment, raster::Derivatives::fine);
    GOBO_TRY(auto report, compare(drawn, vertex, fine, scene, rows_run_down));
    const SpirvModule coarse = raster::with_derivatives(fragment, raster::Derivatives::coarse);
    if (!report.fails() || coarse == fine) return report;
    GOBO_TRY(auto other, compare(drawn, vertex, coarse, scene, rows_run_down));
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
std::optional<ShadowMapReport> compare_maps(Renderer& renderer, const Composition& composition,
                                            const CrossCheckScene& scene) {
    const std::vector<ShadowLight> lights = all_lights(composition, scene);
    if (lights.empty()) return std::nullopt;
    const auto maps = renderer.draw_maps(lights);
    if (!maps) {
        ShadowMapReport report;
        report.diagnostics = maps.error();
        return report;
    }
    const ShadowPlan plan =
        shadow_plan(lights, scene.objects, scene.view.camera.view(), scene.shadow_pass->pass.side);
    return compare_shadow_maps(*maps, *scene.shadow_pass, plan.cameras, scene.objects);
}

CrossCheckReport cross_check_by(Renderer& renderer, const Composition& composition,
                                const Validated& validated, const CrossCheckScene& scene, int jobs) {
    const std::vector<Permutation>& permutations = composition.permutations;
    CrossCheckReport report;
    report.pictures.resize(permutations.size());
    report.shadow_maps = compare_maps(renderer, composition, scene);
    std::vector<Result<Drawn>> drawn(permutations.size());
    std::atomic<std::size_t> ready = 0;
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < permutations.size(); i = next++) {
            for (std::size_t now = ready; now <= i; now = ready) ready.wait(now);
            raster::PictureReport& picture = report.pictures[i];
            if (Result<raster::PictureReport> found = compare(validated, permutations[i], drawn[i], scene,
                                                              composition.dialect == Dialect::vulkan))
                picture = *std::move(found);
            else
                picture.diagnostics = std::move(found).error();
            picture.key = permutations[i].key;
            if (drawn[i]) picture.warnings = std::move(drawn[i]->picture.warnings);
            drawn[i] = Drawn{};
        }
    };
    std::vector<std::jthread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back(work);
    for (std::size_t i = 0; i < permutations.size(); ++i) {
        drawn[i] = renderer.draw(permutations[i]);
        ready = i + 1;
        ready.notify_all();
    }
    threads.clear();  // joins
    return report;
}

}  // namespace

CrossCheckReport cross_check(const Context& context, const Composition& composition,
                             const Validated& validated, const CrossCheckScene& scene, int jobs) {
    OpenGlRenderer renderer(context, composition, validated, scene);
    CrossCheckReport report = cross_check_by(renderer, composition, validated, scene, jobs);
    report.renderer = context.renderer();
    return report;
}

Result<CrossCheckReport> cross_check_by_vulkan(const Composition& composition, const Validated& validated,
                                               const CrossCheckScene& scene, int jobs) {
    VulkanRenderer renderer(composition, validated, scene);
    GOBO_TRY_DO(renderer.draw_all(all_lights(composition, scene), jobs));
    CrossCheckReport report = cross_check_by(renderer, composition, validated, scene, jobs);
    report.renderer = renderer.name();
    report.crashed = renderer.crashed();
    return report;
}

}  // namespace gobo::verify
