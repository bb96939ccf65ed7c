// gobo render: a picture of every permutation of a selection, or of scenes, without a screen.
#include "lab/render/render.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/commands/guarded.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/gallery/gallery.hpp"
#include "lab/gallery/live_page.hpp"
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

Result<PictureOptions> picture_options(const RenderOptions& options) {
    PictureOptions pictures;
    if (options.live && !makes_page(options))
        return fail(Fault::usage, "--page shows --all, --cover or the default set as PNG files, not smoothed",
                    "select keys by one of these");
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

constexpr const char* kBrdfTable = "environmentBrdfTable";

bool looks_up_brdf_table(const std::vector<Interface>& interfaces) {
    return std::ranges::any_of(interfaces, [](const Interface& interface) {
        return std::ranges::count(interface.samplers, kBrdfTable, &Sampler::name) > 0;
    });
}

/// Gives `maps` those of the environment and the table that goes with them, where an interface looks any up.
Result<void> add_environment(const World& world, const std::string& path,
                             const std::vector<Interface>& interfaces, EnvironmentMaps& maps) {
    GOBO_TRY(const auto environment, load_environment(world, path, interfaces));
    for (const auto& [sampler, levels] : environment) GOBO_TRY_DO(maps.add(sampler, levels));
    if (looks_up_brdf_table(interfaces)) maps.add_table(kBrdfTable, environment_brdf_image());
    return {};
}

/// The pictures of all permutations with errors and costs, on one page.
Result<RenderedSelection> render_page(const RenderOptions& options, const World& world,
                                      const LoadedFamily& family, const Composition& composition,
                                      const Validated& validated, const Context& context,
                                      const PictureOptions& pictures, Mesh mesh) {
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
    gallery::GalleryOptions page;
    page.folder = options.folder;
    page.backend = context.backend();
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

/// Draws each key with the demonstration mesh.
Result<RenderedSelection> render_keys(const RenderOptions& options, const World& world, LoadedFamily& family,
                                      const Context& context, PictureOptions pictures) {
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
    const std::vector<Interface> interfaces = interfaces_of(composition, validated);
    if (makes_page(options) && are_usual) {
        GOBO_TRY(auto page, render_page(options, world, family, composition, validated, context, pictures,
                                        std::move(mesh)));
        append(page.diagnostics, warnings_of_environment(options.environment, interfaces));
        return page;
    }
    GOBO_TRY(const auto shadow_pass, load_shadow_pass(world, family.family, composition));
    if (shadow_pass) pictures.depth_pass = &shadow_pass->pass;
    EnvironmentMaps maps(context);
    GOBO_TRY_DO(add_environment(world, options.environment, interfaces, maps));
    pictures.textures = maps.textures();
    RenderedSelection rendered = render_selection(context, family.family, composition, interfaces,
                                                  demo_objects(std::move(mesh)), pictures, world.disk);
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

/// Draws a scene, each draw with the permutation that it needs, into a file that is named after the scene's.
/// What of it is not drawn is added to the notes.
Result<void> render_scene(const RenderOptions& options, const std::string& path, const World& world,
                          const LoadedFamily& family, const Context& context, const PictureOptions& pictures,
                          RenderedSelection& rendered, std::vector<std::string>& notes) {
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
    scene::SceneTextures textures;
    GOBO_TRY(const auto shadow_pass, load_shadow_pass(world, family.family, shaders.composition));
    if (shadow_pass) textures.depth_pass = &shadow_pass->pass;
    EnvironmentMaps maps(context);
    GOBO_TRY_DO(add_environment(world, options.environment, shaders.interfaces, maps));
    append(rendered.diagnostics, warnings_of_environment(options.environment, shaders.interfaces));
    textures.given = maps.textures();
    GOBO_TRY(const Picture picture,
             scene::draw_scene(context, scene, shaders, family.family.render, view, textures));
    // Holes are cut, nothing is blended: what was drawn is opaque, whatever alpha its vertices have.
    Image opaque = picture.color;
    for (std::size_t i = 3; i < opaque.values.size(); i += 4) opaque.values[i] = 1;
    rendered.files.push_back(picture_path(options, pictures, path));
    append(rendered.diagnostics, picture.warnings);
    GOBO_TRY_DO(write_image(world.disk, rendered.files.back(), shrunk(opaque, options.smooth)));
    return {};
}

/// Draws each key with the demonstration mesh, by Vulkan.
Result<RenderedSelection> render_keys_by_vulkan(const RenderOptions& options, const World& world,
                                                LoadedFamily& family, const vulkan::Device& device,
                                                const PictureOptions& pictures, const Progress& progress) {
    if (!options.scenes.empty())
        return fail(Fault::usage, "--backend vulkan draws no scenes", "draw them by --backend osmesa or egl");
    GOBO_TRY(Mesh mesh, load_mesh(world, options.mesh));
    GOBO_TRY(Composition composition, compose_selection(world, family, options));
    if (composition.permutations.empty())
        return RenderedSelection{{}, warn_of_no_keys(composition, "nothing was drawn")};
    GOBO_TRY(const Validated validated, compile(world, family, composition, {.keep_spirv = true}));
    const std::vector<Interface> interfaces = interfaces_of(composition, validated);
    GOBO_TRY(const auto shadow_pass, load_shadow_pass(world, family.family, composition));
    GOBO_TRY(const auto environment, load_environment(world, options.environment, interfaces));
    vulkan::PictureOptions own{pictures.view, pictures.format, pictures.folder, pictures.smooth};
    own.tell = progress;
    for (const auto& [sampler, levels] : environment) own.textures[sampler] = vulkan::cube_texels(levels);
    if (looks_up_brdf_table(interfaces))
        own.textures[kBrdfTable] = vulkan::table_texels(environment_brdf_image());
    vulkan::ShadowPass pass;
    if (shadow_pass) {
        pass.stages = {{StageKind::vertex, shadow_pass->vertex, {}},
                       {StageKind::fragment, shadow_pass->fragment, {}}};
        pass.interface = shadow_pass->pass.interface;
        pass.values = shadow_pass->pass.values;
        own.shadow_pass = &pass;
    }
    std::vector<std::span<const std::uint32_t>> modules;
    for (const ValidatedStage& stage : validated.stages) modules.emplace_back(stage.spirv);
    RenderedSelection rendered =
        vulkan::render_selection(device, family.family, composition, modules, interfaces,
                                 demo_objects(std::move(mesh)), own, world.disk);
    append(rendered.diagnostics, warnings_of_environment(options.environment, interfaces));
    return rendered;
}

Outcome outcome_of(const RenderedSelection& rendered, const PictureOptions& pictures,
                   const std::string& renderer, std::vector<std::string> summary = {}) {
    const auto drawn = std::count_if(rendered.files.begin(), rendered.files.end(),
                                     [](const std::string& file) { return !file.ends_with(".html"); });
    summary.push_back(fmt::format("{} picture{} of {} x {} by {}", drawn, drawn == 1 ? "" : "s",
                                  pictures.view.width / pictures.smooth,
                                  pictures.view.height / pictures.smooth, renderer));
    return {rendered.files.empty() ? "" : join(rendered.files, "\n") + "\n", rendered.diagnostics,
            join(summary, "\n")};
}

Result<Outcome> render(const RenderOptions& options, const World& world, const Progress& progress) {
    GOBO_TRY(const PictureOptions pictures, picture_options(options));
    GOBO_TRY_DO(refuse_equal_names(options, pictures));
    GOBO_TRY(const std::string dialect, dialect_for(options.backend, options.dialect));
    GOBO_TRY(LoadedFamily family, load_family(world, options.family, dialect));
    if (options.backend == kVulkanBackend) {
        GOBO_TRY(const vulkan::Device device, vulkan::open_device());
        GOBO_TRY(const auto rendered,
                 render_keys_by_vulkan(options, world, family, device, pictures, progress));
        return outcome_of(rendered, pictures, device.name());
    }
    GOBO_TRY(const Backend backend, backend_of(options.backend));
    GOBO_TRY(const Context context, open_context(backend));
    RenderedSelection rendered;
    std::vector<std::string> notes;
    for (const std::string& path : options.scenes)
        GOBO_TRY_DO(render_scene(options, path, world, family, context, pictures, rendered, notes));
    if (options.scenes.empty() || selects_keys(options)) {
        GOBO_TRY(const auto keys, render_keys(options, world, family, context, pictures));
        rendered.files.insert(rendered.files.end(), keys.files.begin(), keys.files.end());
        append(rendered.diagnostics, keys.diagnostics);
    }
    return outcome_of(rendered, pictures, context.renderer(), std::move(notes));
}

/// In a process that a driver may end.
Result<Outcome> run(const RenderOptions& options, const World& world) {
    return run_guarded("the renderer of --backend " + options.backend, [&](const Progress& progress) {
        ToldFiles files(world.disk, progress);
        World told{files, world.shipped, world.options, world.measure, world.cache, world.tell};
        return render(options, told, progress);
    });
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
             {"--backend", kBackends, "What draws; vulkan draws keys without a page, and no scenes",
              &options->backend},
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
