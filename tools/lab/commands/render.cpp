// gobo render: a picture of every permutation of a selection, or of scenes, without a screen.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/gallery/gallery.hpp"
#include "lab/gallery/live_page.hpp"
#include "lab/render/driver_tasks.hpp"
#include "lab/render/render_selection.hpp"
#include "lab/render/texture.hpp"
#include "lab/scene_picture/draw_scene.hpp"
#include "lab/vulkan/picture.hpp"
#include "scene/read_scene.hpp"

namespace gobo {
namespace {

struct RenderOptions : SelectionOptions {
    std::string folder;
    std::string size;
    int smooth = 1;
    std::string backend = "osmesa";
    std::string format = "png";
    std::string mesh = "teapot";
    std::string environment;
    int camera = -1;  ///< of scenes; below 0: each scene's first
    bool live = false;
};

/// Slightly from above and from the side, where a scene has no camera.
const glm::dvec3 kUsualDirection(0.5, 0.4, 1);

/// Texels along each side of a page's shadow maps: as fine as its pictures are, a quarter of the work of
/// others.
constexpr int kPageShadowSide = 512;

/// What is left of a selection without its scenes.
bool selects_keys(const SelectionOptions& selection) {
    return !selection.keys.empty() || !selection.key_files.empty() || selection.more.all ||
           selection.more.cover != 0;
}

/// Pictures for the eye of keys that nobody named go on a page.
bool makes_page(const RenderOptions& options) {
    const bool is_default_set = !selects_keys(options) && options.scenes.empty();
    return options.format == "png" && options.smooth == 1 &&
           (options.more.all || options.more.cover != 0 || is_default_set);
}

/// How all pictures are taken, and as what they are written.
struct PictureOptions : PictureFiles {
    View view;
};

Result<PictureOptions> picture_options(const RenderOptions& options) {
    PictureOptions pictures;
    if (options.live && !makes_page(options))
        return fail(Fault::usage, "--page shows --all, --cover or the default set as PNG files, not smoothed",
                    "select keys by one of these");
    if (options.live && options.backend == kVulkanBackend)
        return fail(Fault::usage, "--backend vulkan makes no page", "leave --page out, or --backend");
    const std::string usual = options.live ? "240x180" : makes_page(options) ? "400x300" : "640x480";
    GOBO_TRY(const auto size, read_size(options.size.empty() ? usual : options.size));
    GOBO_TRY(pictures.format, image_format_of(options.format));
    pictures.view.camera = gallery::gallery_camera();
    pictures.smooth = options.smooth;
    if (std::max(size.first, size.second) * options.smooth > kLargestSide)
        return fail(Fault::usage,
                    fmt::format("--smooth {} of {} x {} pixels draws more than {} pixels a side",
                                options.smooth, size.first, size.second, kLargestSide),
                    "draw fewer pixels, or smooth them less");
    pictures.view.width = size.first * options.smooth;
    pictures.view.height = size.second * options.smooth;
    pictures.view.background = {0.05F, 0.06F, 0.08F, 1};
    pictures.folder = options.folder;
    return pictures;
}

/// In messages.
std::string renderer_of(const RenderOptions& options) {
    return "the renderer of --backend " + options.backend;
}

constexpr const char* kBrdfTable = "environmentBrdfTable";

bool looks_up_brdf_table(const std::vector<Interface>& interfaces) {
    return std::ranges::any_of(interfaces, [](const Interface& interface) {
        return std::ranges::count(interface.samplers, kBrdfTable, &Sampler::name) > 0;
    });
}

/// What pictures are lit by: maps, and the table that goes with them where an interface looks it up.
struct Environment {
    CubeImages cubes;
    bool has_table = false;

    Result<void> add_to(EnvironmentMaps& maps) const {
        for (const auto& [sampler, levels] : cubes) GOBO_TRY_DO(maps.add(sampler, levels));
        if (has_table) maps.add_table(kBrdfTable, environment_brdf_image());
        return {};
    }
    [[nodiscard]] vulkan::Textures for_vulkan() const {
        vulkan::Textures textures;
        for (const auto& [sampler, levels] : cubes) textures[sampler] = vulkan::cube_texels(levels);
        if (has_table) textures[kBrdfTable] = vulkan::table_texels(environment_brdf_image());
        return textures;
    }
};

Result<Environment> environment_of(const World& world, const std::string& path,
                                   const std::vector<Interface>& interfaces) {
    GOBO_TRY(auto cubes, load_environment(world, path, interfaces));
    return Environment{std::move(cubes), looks_up_brdf_table(interfaces)};
}

/// An error where a picture of a key, or what stands beside it on a page, would take the place of what was
/// read.
Result<void> refuse_inputs(const World& world, const PictureOptions& pictures, const Family& family,
                           const Composition& composition, const std::vector<std::string>& ends) {
    std::vector<std::string> files;
    for (const Permutation& permutation : composition.permutations)
        for (const std::string& end : ends)
            files.push_back(pictures.folder + "/" + picture_name(key_text(family, permutation.key)) + end);
    return world.refuse_inputs(files);
}

/// The pictures of all permutations with errors and costs, on one page.
Result<RenderedSelection> render_page(const RenderOptions& options, const World& world,
                                      const LoadedFamily& family, const Composition& composition,
                                      const Validated& validated, const PictureOptions& pictures, Mesh mesh) {
    gallery::Scene scene;
    scene.objects = demo_objects(std::move(mesh));
    scene.view = pictures.view;
    GOBO_TRY(scene.cube_maps,
             load_environment(world, options.environment, interfaces_of(composition, validated)));
    GOBO_TRY(const auto shadow_pass, load_shadow_pass(world, family.family, composition));
    if (shadow_pass) {
        scene.depth_pass = shadow_pass->pass;
        scene.depth_pass.side = kPageShadowSide;
    }
    GOBO_TRY_DO(
        refuse_inputs(world, pictures, family.family, composition, {".png", ".expected.png", ".error.png"}));
    gallery::GalleryOptions page;
    page.folder = options.folder;
    page.driver = renderer_of(options);
    GOBO_TRY(page.backend, backend_of(options.backend));
    page.jobs = world.jobs();
    GOBO_TRY(page.weights, load_weights(world));
    if (!options.live)
        return gallery::make_gallery(scene, family.family, composition, validated, page, world.disk,
                                     world.shipped);
    LoadedFamily for_browsers = family;
    for_browsers.dialect = Dialect::es300;
    std::vector<Key> keys;
    for (const Permutation& permutation : composition.permutations) keys.push_back(permutation.key);
    GOBO_TRY(Composition in_browsers, compose_keys(for_browsers, keys));
    GOBO_TRY(const Validated valid_there, compile(world, for_browsers, in_browsers));
    const std::vector<Interface> interfaces = interfaces_of(in_browsers, valid_there);
    gallery::LivePage live(family.family, scene, in_browsers, interfaces);
    page.live = &live;
    return gallery::make_gallery(scene, family.family, composition, validated, page, world.disk,
                                 world.shipped);
}

/// An error about each key that the driver died of, with what it was given.
void keep_deaths(const World& world, const PictureOptions& pictures, const Family& family,
                 const Composition& composition, const Validated& validated, RenderedSelection& rendered) {
    for (DriverDeath& death : rendered.deaths)
        append(rendered.diagnostics,
               with_kept_stages(world, pictures.folder, family, composition, validated,
                                composition.permutations[death.permutation], std::move(death.errors)));
}

/// Draws each key with the demonstration mesh.
Result<RenderedSelection> render_keys(const RenderOptions& options, const World& world, LoadedFamily& family,
                                      const PictureOptions& pictures) {
    GOBO_TRY(Mesh mesh, load_mesh(world, options.mesh));
    SelectionOptions keys = options;
    keys.scenes.clear();
    const Dialect drawn = family.dialect;
    if (options.live) family.dialect = Dialect::es300;  // its rules say what browsers can draw
    GOBO_TRY(const std::vector<Key> selected, load_keys(world, family, keys));
    family.dialect = drawn;
    GOBO_TRY(Composition composition, compose_keys(family, selected));
    if (composition.permutations.empty())
        return RenderedSelection{{}, warn_of_no_keys(composition, "nothing was drawn")};
    for (const Permutation& permutation : composition.permutations)
        if (permutation.stages[StageKind::compute] >= 0)
            return fail(Place{family.family.path}, "",
                        fmt::format("the key '{}' has a compute stage, which draws nothing",
                                    key_text(family.family, permutation.key)),
                        "leave it out by --where");
    GOBO_TRY(const Validated validated, compile(world, family, composition, {.keep_spirv = true}));
    const bool are_usual = std::ranges::all_of(composition.permutations, [](const Permutation& permutation) {
        return permutation.stages.is_usual_pair();
    });
    const bool by_vulkan = options.backend == kVulkanBackend;
    const std::vector<Interface> interfaces = interfaces_of(composition, validated);
    RenderedSelection rendered;
    if (makes_page(options) && are_usual && !by_vulkan) {
        GOBO_TRY(rendered,
                 render_page(options, world, family, composition, validated, pictures, std::move(mesh)));
    } else {
        GOBO_TRY(const auto shadow_pass, load_shadow_pass(world, family.family, composition));
        GOBO_TRY(const Environment environment, environment_of(world, options.environment, interfaces));
        GOBO_TRY_DO(refuse_inputs(world, pictures, family.family, composition,
                                  {fmt::format(".{}", name_of(pictures.format))}));
        const std::vector<Object> objects = demo_objects(std::move(mesh));
        const DrawnSelection selection{family.family, composition, interfaces, objects, pictures.view};
        const vulkan::ShadowPass vulkan_pass = shadow_pass ? shadow_pass->for_vulkan() : vulkan::ShadowPass();
        std::optional<EnvironmentMaps> maps;  // of a child process
        const auto open = [&]() -> Result<std::unique_ptr<KeyRenderer>> {
            if (by_vulkan) {
                GOBO_TRY(const vulkan::Device device, vulkan::open_device());
                std::vector<std::span<const std::uint32_t>> modules;
                for (const ValidatedStage& stage : validated.stages) modules.emplace_back(stage.spirv);
                return vulkan::vulkan_renderer(device, selection, modules, environment.for_vulkan(),
                                               shadow_pass ? &vulkan_pass : nullptr);
            }
            GOBO_TRY(const Backend backend, backend_of(options.backend));
            GOBO_TRY(const Context context, open_context(backend));
            GOBO_TRY_DO(environment.add_to(maps.emplace(context)));
            return opengl_renderer(context, selection, maps->textures(),
                                   shadow_pass ? &shadow_pass->pass : nullptr);
        };
        GOBO_TRY(rendered, render_selection(renderer_of(options), world.jobs(), family.family, composition,
                                            pictures, world.disk, open));
    }
    keep_deaths(world, pictures, family.family, composition, validated, rendered);
    append(rendered.diagnostics, warnings_of_environment(options.environment, interfaces));
    return rendered;
}

Result<scene::SceneView> view_of(const scene::Scene& scene, const std::vector<scene::Draw>& draws, int camera,
                                 const View& size) {
    const auto first = scene::first_camera(scene);
    const auto chosen = camera >= 0 ? std::optional(static_cast<std::size_t>(camera)) : first;
    if (!chosen) {
        scene::SceneView view =
            scene::view_of_all(scene::bounds_at_rest(scene, draws), kUsualDirection, size.width, size.height);
        view.background = scene::background_of(scene);
        return view;
    }
    if (auto view = scene::view_of_camera(scene, *chosen, size.width, size.height)) return *view;
    return fail(Fault::usage,
                fmt::format("--camera: no node of '{}' holds a camera '{}'", scene.path, camera),
                fmt::format("the file has {} cameras, numbered from 0", scene.cameras.size()));
}

/// Named after the scene's file.
std::string picture_path(const RenderOptions& options, const PictureOptions& pictures,
                         const std::string& scene) {
    return fmt::format("{}/{}.{}", options.folder, stem_of(scene), name_of(pictures.format));
}

/// Two scenes' pictures would be one file.
Result<void> refuse_equal_names(const RenderOptions& options, const PictureOptions& pictures) {
    std::map<std::string, std::string> scenes;  // by the path of the picture
    for (const std::string& scene : options.scenes) {
        const auto [first, is_new] = scenes.emplace(picture_path(options, pictures, scene), scene);
        if (!is_new && first->second != scene)
            return fail(Fault::usage,
                        fmt::format("'{}' and '{}' would both be drawn into '{}'", first->second, scene,
                                    first->first),
                        "draw them by two commands, into two folders");
    }
    return {};
}

/// One of the two.
struct SceneRenderer {
    std::optional<Context> context;
    std::optional<vulkan::Device> device;
};

Result<SceneRenderer> open_scene_renderer(const RenderOptions& options) {
    SceneRenderer renderer;
    if (options.backend == kVulkanBackend) {
        GOBO_TRY(renderer.device, vulkan::open_device());
    } else {
        GOBO_TRY(const Backend backend, backend_of(options.backend));
        GOBO_TRY(renderer.context, open_context(backend));
    }
    return renderer;
}

/// Draws a scene, each draw with the permutation that it needs, as a file that is named after the scene's.
/// What of it is not drawn is added to the notes.
Result<void> render_scene(const RenderOptions& options, const std::string& path, const World& world,
                          const LoadedFamily& family, const PictureOptions& pictures,
                          RenderedSelection& rendered, std::vector<OutputFile>& files,
                          std::vector<std::string>& notes) {
    GOBO_TRY(const scene::Buckets buckets, scene::parse_buckets(options.bucket_lights));
    GOBO_TRY(const scene::Scene scene,
             scene::read_scene(world.disk, path, scene::reading_for(family.family)));
    append(rendered.diagnostics, scene.warnings);
    auto draws = scene::required_effects(scene, scene::eye_of_cameras(scene), {});
    GOBO_TRY(const scene::SceneView view, view_of(scene, draws, options.camera, pictures.view));
    GOBO_TRY(const auto keys, scene::keys_for_draws(family.family, draws, buckets, name_of(family.dialect)));
    std::ranges::move(scene::notes_on_scene(scene, draws, keys), std::back_inserter(notes));
    if (scene::turns_all_faces_away(scene, draws, view))
        notes.push_back(
            one_line(fmt::format("{}: every face is turned away from the viewer: mark its materials "
                                 "doubleSided, or turn the winding round",
                                 scene.path)));
    GOBO_TRY(const auto shaders, scene::shaders_for_draws(family.family, family.search, std::move(draws),
                                                          buckets, family.dialect, world.jobs()));
    GOBO_TRY(const auto shadow_pass, load_shadow_pass(world, family.family, shaders.composition));
    GOBO_TRY(const Environment environment, environment_of(world, options.environment, shaders.interfaces));
    append(rendered.diagnostics, warnings_of_environment(options.environment, shaders.interfaces));
    DriverTasks<SceneRenderer, PictureFile> tasks{renderer_of(options), 1};
    tasks.open = [&] { return open_scene_renderer(options); };
    tasks.work = [&](const SceneRenderer& renderer, std::size_t, DriverClock& clock) -> Result<PictureFile> {
        Picture picture;
        if (renderer.device) {
            const vulkan::ShadowPass pass = shadow_pass ? shadow_pass->for_vulkan() : vulkan::ShadowPass();
            GOBO_TRY(picture, scene::draw_scene_by_vulkan(
                                  *renderer.device, scene, shaders, family.family.render, view,
                                  {shadow_pass ? &pass : nullptr, environment.for_vulkan()}, &clock));
        } else {
            EnvironmentMaps maps(*renderer.context);
            GOBO_TRY_DO(environment.add_to(maps));
            GOBO_TRY(picture, scene::draw_scene(*renderer.context, scene, shaders, family.family.render, view,
                                                {shadow_pass ? &shadow_pass->pass : nullptr, maps.textures()},
                                                &clock));
        }
        clock.stop();
        // Holes are cut, nothing is blended: what was drawn is opaque, whatever alpha its vertices have.
        for (std::size_t i = 3; i < picture.color.values.size(); i += 4) picture.color.values[i] = 1;
        return picture_file(std::move(picture), pictures,
                            renderer.device ? renderer.device->name() : renderer.context->renderer());
    };
    tasks.done = [&](std::size_t, Result<PictureFile> picture, std::optional<int> death) {
        if (death) {
            const auto number = static_cast<std::size_t>(*death);
            append(rendered.diagnostics,
                   with_kept_stages(world, pictures.folder, family.family, shaders.composition,
                                    shaders.validated, shaders.composition.permutations[number],
                                    std::move(picture).error()));
        } else if (!picture) {
            append(rendered.diagnostics, picture.error());
        } else {
            rendered.renderer = picture->renderer;
            append(rendered.diagnostics, picture->warnings);
            files.push_back({picture_path(options, pictures, path), std::move(picture->bytes)});
        }
    };
    return ask_driver(tasks);
}

Outcome outcome_of(const RenderedSelection& rendered, const PictureOptions& pictures,
                   std::vector<std::string> summary) {
    const auto drawn = std::count_if(rendered.files.begin(), rendered.files.end(),
                                     [](const std::string& file) { return !file.ends_with(".html"); });
    summary.push_back(fmt::format(
        "{} picture{} of {} x {}{}", drawn, drawn == 1 ? "" : "s", pictures.view.width / pictures.smooth,
        pictures.view.height / pictures.smooth, rendered.renderer.empty() ? "" : " by " + rendered.renderer));
    return {rendered.files.empty() ? "" : join(rendered.files, "\n") + "\n", rendered.diagnostics,
            join(summary, "\n")};
}

Result<Outcome> run(const RenderOptions& options, const World& world) {
    GOBO_TRY(const PictureOptions pictures, picture_options(options));
    GOBO_TRY_DO(refuse_equal_names(options, pictures));
    GOBO_TRY(const std::string dialect, dialect_for(options.backend, options.dialect));
    GOBO_TRY(LoadedFamily family, load_family(world, options.family, dialect));
    RenderedSelection rendered;
    std::vector<std::string> notes;
    std::vector<OutputFile> files;  // written when all is read
    for (const std::string& path : options.scenes)
        GOBO_TRY_DO(render_scene(options, path, world, family, pictures, rendered, files, notes));
    std::vector<std::string> paths;
    for (const OutputFile& file : files) paths.push_back(file.path);
    GOBO_TRY_DO(world.refuse_inputs(paths));
    RenderedSelection keys;
    if (options.scenes.empty() || selects_keys(options)) {
        GOBO_TRY(keys, render_keys(options, world, family, pictures));
    }
    for (const OutputFile& file : files)
        if (const auto written = world.disk.write(file.path, file.content))
            rendered.files.push_back(file.path);
        else
            append(rendered.diagnostics, written.error());
    rendered.files.insert(rendered.files.end(), keys.files.begin(), keys.files.end());
    append(rendered.diagnostics, keys.diagnostics);
    if (!keys.renderer.empty()) rendered.renderer = keys.renderer;
    return outcome_of(rendered, pictures, std::move(notes));
}

}  // namespace

Command render_command() {
    const auto options = std::make_shared<RenderOptions>();
    options->family = "lit";
    return {titles::kRender,
            {family_argument(options->family),
             {"-o,--output", "DIR", "Folder for the pictures, which are named after the keys",
              &options->folder, kRequired},
             {"--size", "WxH", "Pixels; by default 640x480, 400x300 on a page, and 240x180 with --page",
              &options->size},
             {"--smooth", "N", "Make each pixel the average of N x N; without a page", &options->smooth,
              between(1, 8)},
             {"--backend", kBackends, "What draws; vulkan draws keys without a page", &options->backend},
             {"--format", "png|exr|pfm", "png is sRGB for the eye; exr and pfm hold linear floats",
              &options->format},
             {"--page", "", "Beside a page live.html: it draws every key, of those that es300 allows, itself",
              &options->live},
             {"--mesh", "teapot|sphere|torus|plane|FILE.obj", "What stands on the plane", &options->mesh},
             {"--camera", "N",
              "Number in the file of the camera that sees the scenes; by default each one's first, or a view "
              "of everything",
              &options->camera, kNotNegative},
             {"--environment", "FILE.exr|DIR",
              "The light of ambient=image and reflection=image: a latitude-longitude map, or what gobo probe "
              "wrote, which no roughness blurs; by default a studio",
              &options->environment},
             dialect_option(options->dialect)},
            {selection_options(*options)},
            "  gobo render --scene room.gltf -o pictures\n"
            "  gobo render lit --key 'directional=1 specular=blinn' -o pictures\n"
            "  gobo render lit --cover 2 --where 'point <= 2' -o pictures --size 320x240 --backend egl\n"
            "  gobo render lit --key 'spot=1' -o pictures --format exr --mesh torus --dialect 330\n"
            "  gobo render lit --key 'point=3' -o pictures --backend vulkan\n"
            "  gobo render game.toml --all -o pictures",
            [options](const World& world) { return run(*options, world); },
            "Prints the paths of the pictures. Pictures of --all, --cover or the default set come with a "
            "page, index.html, that shows each one's error and cost, and beside it the picture that was "
            "expected. The family's [render] table says what its uniforms hold; with --scene the scene does, "
            "and each of its draws has the permutation that it needs."};
}

}  // namespace gobo
