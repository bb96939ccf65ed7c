// gobo render: a picture of every permutation of a selection, without a screen.
#include "lab/render/render.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "core/text.hpp"
#include "lab/commands/commands.hpp"
#include "lab/commands/depth_pass.hpp"
#include "lab/commands/environment.hpp"
#include "lab/commands/render_gallery.hpp"
#include "lab/commands/render_scene.hpp"
#include "lab/gallery/picture.hpp"
#include "lab/render/texture.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct RenderOptions {
    CommonOptions common;
    SelectionOptions selection;
    std::string family = "lit";
    std::string dialect;
    std::string folder;
    std::string size;
    int smooth = 1;
    std::string backend = "osmesa";
    std::string format = "png";
    std::string mesh = "teapot";
    std::string environment;
    int camera = -1;  ///< of scenes; below 0: each scene's first
};

/// "640x480"
Result<std::pair<int, int>> read_size(const std::string& text) {
    std::pair<int, int> size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.first);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.second);
        if (height.ec == std::errc() && height.ptr == end && size.first > 0 && size.second > 0) return size;
    }
    return fail(Fault::usage, fmt::format("'{}' is no size", text), "write width x height, such as 640x480");
}

Result<Mesh> read_mesh(const World& world, const std::string& name) {
    if (name == "teapot") return read_obj(world.shipped, "data/meshes/teapot.obj");
    if (name == "sphere") return make_sphere(64, 32);
    if (name == "torus") return make_torus(1, 0.4, 96, 48);
    if (name == "plane") return make_plane(3, 32);
    if (name.ends_with(".obj")) return read_obj(world.disk, name);
    return fail(Fault::usage, fmt::format("there is no mesh '{}'", name),
                suggestion(name, {"plane", "sphere", "teapot", "torus"}) + "; or name an .obj file");
}

/// What is left of a selection without its scenes.
bool selects_keys(const SelectionOptions& selection) {
    return !selection.keys.empty() || !selection.key_files.empty() || selection.all || selection.cover != 0;
}

/// Pictures for the eye of keys that nobody named go on a page.
bool makes_page(const RenderOptions& options) {
    const SelectionOptions& selection = options.selection;
    const bool is_default_set = !selects_keys(selection) && selection.scenes.empty();
    return options.format == "png" && options.smooth == 1 &&
           (selection.all || selection.cover != 0 || is_default_set);
}

Result<PictureOptions> read_options(const RenderOptions& options) {
    const std::string usual = makes_page(options) ? "400x300" : "640x480";
    const auto size = read_size(options.size.empty() ? usual : options.size);
    if (!size) return tl::unexpected(size.error());
    const auto format = image_format_of(options.format);
    if (!format) return tl::unexpected(format.error());
    PictureOptions pictures;
    pictures.view.camera = gallery::gallery_camera();
    pictures.smooth = options.smooth;
    pictures.view.width = size->first * options.smooth;
    pictures.view.height = size->second * options.smooth;
    pictures.view.background = {0.05F, 0.06F, 0.08F, 1};
    pictures.format = *format;
    pictures.folder = options.folder;
    return pictures;
}

Result<Validated> validate_all(const Family& family, const Composition& composition, int jobs) {
    ValidateOptions options;
    options.jobs = jobs;
    options.keep_spirv = true;
    Validated validated = validate(family, composition, options);
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(validated.diagnostics);
    return validated;
}

std::vector<Interface> interfaces_of(const Composition& composition, const Validated& validated) {
    std::vector<Interface> interfaces;
    for (const Permutation& permutation : composition.permutations)
        interfaces.push_back(interface_of(validated, permutation));
    return interfaces;
}

/// Draws each key with the demonstration mesh.
Result<RenderedSelection> render_keys(const RenderOptions& options, const World& world, LoadedFamily& family,
                                      Dialect dialect, const Context& context, PictureOptions pictures) {
    const auto mesh = read_mesh(world, options.mesh);
    if (!mesh) return tl::unexpected(mesh.error());
    SelectionOptions selection = options.selection;
    selection.scenes.clear();
    const auto composition = load_composition(world, family, selection, dialect);
    if (!composition) return tl::unexpected(composition.error());
    const auto validated = validate_all(family.family, *composition, options.common.jobs);
    if (!validated) return tl::unexpected(validated.error());
    const std::vector<Interface> interfaces = interfaces_of(*composition, *validated);
    const auto environment = environment_for(world, options.environment, options.common.jobs, interfaces);
    if (!environment) return tl::unexpected(environment.error());
    if (makes_page(options))
        return render_gallery(world, options.common, family.family, *composition, *validated,
                              {*mesh, pictures.view, pictures.folder, context.backend(), *environment});
    DepthPass depth_pass;
    if (has_shadows(family.family, *composition)) {
        auto loaded = load_depth_pass(world, options.common);
        if (!loaded) return tl::unexpected(loaded.error());
        depth_pass = std::move(*loaded);
        pictures.depth_pass = &depth_pass;
    }
    CubeMaps cubes(context);
    for (const auto& [sampler, image] : *environment)
        if (const auto added = cubes.add(sampler, image); !added) return tl::unexpected(added.error());
    pictures.textures = cubes.textures();
    return render_selection(context, family.family, *composition, interfaces, demo_objects(*mesh), pictures,
                            world.disk);
}

Result<RenderedSelection> render_both(const RenderOptions& options, const World& world, LoadedFamily& family,
                                      Dialect dialect, const Context& context,
                                      const PictureOptions& pictures) {
    RenderedSelection rendered;
    for (const std::string& path : options.selection.scenes) {
        auto picture = render_scene({path, options.camera, options.selection.bucket_lights, dialect,
                                     options.common, options.environment},
                                    world, family, context, pictures);
        if (!picture) return tl::unexpected(picture.error());
        rendered.files.push_back(std::move(picture->file));
        rendered.diagnostics.insert(rendered.diagnostics.end(), picture->warnings.begin(),
                                    picture->warnings.end());
    }
    if (!options.selection.scenes.empty() && !selects_keys(options.selection)) return rendered;
    const auto keys = render_keys(options, world, family, dialect, context, pictures);
    if (!keys) return tl::unexpected(keys.error());
    rendered.files.insert(rendered.files.end(), keys->files.begin(), keys->files.end());
    rendered.diagnostics.insert(rendered.diagnostics.end(), keys->diagnostics.begin(),
                                keys->diagnostics.end());
    return rendered;
}

Outcome run(const RenderOptions& options, const World& world) {
    const auto pictures = read_options(options);
    if (!pictures) return failed(pictures.error());
    const auto backend = backend_of(options.backend);
    if (!backend) return failed(backend.error());
    const Result<Dialect> dialect = read_dialect(options.dialect);
    if (!dialect) return failed(dialect.error());
    Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const auto context = open_context(*backend);
    if (!context) return failed(context.error());
    const auto rendered = render_both(options, world, *family, *dialect, *context, *pictures);
    if (!rendered) return failed(rendered.error());
    const std::string files = rendered->files.empty() ? "" : join(rendered->files, "\n") + "\n";
    const auto drawn = std::count_if(rendered->files.begin(), rendered->files.end(),
                                     [](const std::string& file) { return !file.ends_with("/index.html"); });
    return {files, rendered->diagnostics,
            fmt::format("{} picture{} of {} x {} by {}", drawn, drawn == 1 ? "" : "s",
                        pictures->view.width / pictures->smooth, pictures->view.height / pictures->smooth,
                        context->renderer())};
}

}  // namespace

Command render_command(CLI::App& gobo) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* app = gobo.add_subcommand("render", "A picture of every key of a selection, or of scenes");
    app->add_option("FAMILY", options->family, "A shipped family or a .toml file; by default lit");
    add_selection_options(*app, options->selection);
    app->add_option("-o,--output", options->folder, "Folder for the pictures, which are named after the keys")
        ->type_name("DIR")
        ->required();
    app->add_option("--size", options->size, "Pixels; by default 640x480, and 400x300 on a page")
        ->type_name("WxH");
    app->add_option("--smooth", options->smooth, "Make each pixel the average of N x N; without a page")
        ->type_name("N")
        ->check(CLI::Range(1, 8));
    app->add_option("--backend", options->backend, "What draws")
        ->type_name("osmesa|egl")
        ->capture_default_str();
    app->add_option("--format", options->format, "png is sRGB for the eye; exr and pfm hold linear floats")
        ->type_name("png|exr|pfm")
        ->capture_default_str();
    app->add_option("--mesh", options->mesh, "What stands on the plane")
        ->type_name("teapot|sphere|torus|plane|FILE.obj")
        ->capture_default_str();
    app->add_option(
           "--camera", options->camera,
           "Number in the file of the camera that sees the scenes; by default each one's first, or a "
           "view of everything")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);
    app->add_option(
           "--environment", options->environment,
           "What gobo probe wrote: the light of keys with ambient=image or reflection=image; by default "
           "a studio")
        ->type_name("DIR");
    add_dialect_option(*app, options->dialect);
    add_common_options(*app, options->common);
    app->footer(
        "Prints the paths of the pictures. Pictures of --all, --cover or the default set come with a page, "
        "index.html, that\ntells each one's error and cost, and beside them with what was expected. The "
        "family's [render] table says what its uniforms hold; with "
        "--scene the scene does, and each of its draws has the permutation that it calls for.\n\n"
        "Examples:\n"
        "  gobo render --scene room.gltf -o pictures\n"
        "  gobo render lit --key 'directional=1 specular=blinn' -o pictures\n"
        "  gobo render lit --cover 2 --where 'point <= 2' -o pictures --size 320x240 --backend egl\n"
        "  gobo render lit --key 'spot=1' -o pictures --format exr --mesh torus --dialect 330\n"
        "  gobo render game.toml --all -o pictures");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
