#include "lab/commands/witness.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "family/key.hpp"
#include "lab/commands/depth_pass.hpp"
#include "lab/commands/environment.hpp"
#include "lab/render/render.hpp"
#include "lab/verify/witness.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

constexpr int kSide = 64;

/// A difference of this much is white in the picture of differences.
constexpr float kWhiteDifference = 1e-3F;

/// The side of a shadow map: coarse, so that many edges of its texels are seen.
constexpr int kMapSide = 64;

bool looks_up_environment(const Validated& validated) {
    return std::any_of(validated.stages.begin(), validated.stages.end(), [](const ValidatedStage& stage) {
        const auto& samplers = stage.interface.samplers;
        return std::any_of(samplers.begin(), samplers.end(), [](const Sampler& sampler) {
            return sampler.name == "diffuseMap" || sampler.name == "specularMap";
        });
    });
}

/// The scene that `gobo render` shows, smaller.
Result<verify::WitnessScene> make_scene(const World& world, const Family& family, const Validated& validated,
                                        int jobs) {
    Result<Mesh> teapot = read_obj(world.shipped, "data/meshes/teapot.obj");
    if (!teapot) return tl::unexpected(teapot.error());
    verify::WitnessScene scene;
    scene.objects = demo_objects(std::move(*teapot));
    scene.values = family.render;
    scene.family = &family;
    scene.view.camera = demo_camera();
    scene.view.width = scene.view.height = kSide;
    if (!looks_up_environment(validated)) return scene;
    auto cubes = load_environment(world, {}, jobs);
    if (!cubes) return tl::unexpected(cubes.error());
    scene.cubes = std::move(*cubes);
    return scene;
}

Diagnostics write_images(FileSystem& disk, const std::string& stem, const verify::PictureReport& report) {
    Diagnostics diagnostics;
    const auto write = [&](const std::string& path, const Image& image) {
        const Result<bool> written = write_image(disk, path, image);
        if (!written) diagnostics.insert(diagnostics.end(), written.error().begin(), written.error().end());
    };
    write(stem + ".actual.exr", report.actual);
    write(stem + ".expected.exr", report.expected);
    write(stem + ".difference.png", difference_picture(report.actual, report.expected, kWhiteDifference));
    return diagnostics;
}

Diagnostics report_failure(const World& world, const std::string& folder, const std::string& key,
                           const verify::PictureReport& report) {
    Diagnostic error;
    error.subject = key;
    error.message =
        fmt::format("{} of {} pixels are not what the evaluation gives, {} at an edge, rms {:.1e}",
                    report.wrong, report.pixels, report.edges, report.root_mean_square);
    for (const verify::WrongPixel& pixel : report.worst)
        error.message +=
            fmt::format("\n  pixel ({}, {}): drawn {:.7g}, evaluated {:.7g}, {:.3g} times the limit", pixel.x,
                        pixel.y, fmt::join(pixel.actual, " "), fmt::join(pixel.expected, " "), pixel.ratio);
    const std::string stem = fmt::format("{}/{}", folder, picture_name(key));
    error.help = fmt::format("see {}.actual.exr, .expected.exr and .difference.png", stem);
    Diagnostics diagnostics = {std::move(error)};
    const Diagnostics written = write_images(world.disk, stem, report);
    diagnostics.insert(diagnostics.end(), written.begin(), written.end());
    return diagnostics;
}

/// What the run found, all permutations together.
struct Totals {
    double largest_error = 0;
    double root_mean_square = 0;  ///< of the worst permutation
    double largest_ratio = 0;
    std::size_t pixels = 0;
    std::size_t drawn = 0;
    std::size_t edges = 0;
};

std::string totals_text(const Totals& totals, std::size_t permutations, const std::string& renderer) {
    const auto share = [&](std::size_t part) {
        return totals.pixels > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(totals.pixels) : 0;
    };
    return fmt::format(
        "{} x {} pixels: {:.1f} % drawn, {} ({:.3f} %) decided at an edge; at most {:.2f} of the limit\n"
        "{} permutations drawn by {}, max {:.1e}, rms {:.1e}\n",
        kSide, kSide, share(totals.drawn), totals.edges, share(totals.edges), totals.largest_ratio,
        permutations, renderer, totals.largest_error, totals.root_mean_square);
}

void add(const verify::PictureReport& picture, Totals& totals) {
    totals.largest_error = std::max(totals.largest_error, picture.largest_error);
    totals.root_mean_square = std::max(totals.root_mean_square, picture.root_mean_square);
    totals.largest_ratio = std::max(totals.largest_ratio, picture.largest_ratio);
    totals.pixels += picture.pixels;
    totals.drawn += picture.drawn;
    totals.edges += picture.edges;
}

/// What became of the shadow maps; nothing where none were drawn.
std::string maps_text(const std::optional<verify::ShadowMapReport>& report, Diagnostics& diagnostics) {
    if (!report) return {};
    diagnostics.insert(diagnostics.end(), report->diagnostics.begin(), report->diagnostics.end());
    if (report->fails()) {
        const std::string message =
            fmt::format("{} of the {} texels of shadow maps are not what the evaluation gives, {} at an edge",
                        report->wrong, report->texels, report->edges);
        const Diagnostics failed = fail(Fault::input, message).value();
        diagnostics.insert(diagnostics.end(), failed.begin(), failed.end());
    }
    return fmt::format(
        "{} shadow maps of {} x {} texels, {} decided at an edge; at most {:.2f} of the limit\n",
        report->maps, kMapSide, kMapSide, report->edges, report->largest_ratio);
}

}  // namespace

CLI::Option* add_witness_options(CLI::App& app, WitnessOptions& options) {
    CLI::Option* render =
        app.add_flag("--render", options.render,
                     "Draw every key, 64 x 64, and hold each pixel against the evaluation instead");
    app.add_option("--backend", options.backend, "What draws")
        ->type_name("osmesa|egl")
        ->capture_default_str()
        ->needs(render);
    return render;
}

Outcome run_witness(const World& world, const WitnessOptions& options, const Family& family,
                    const Composition& composition, const std::string& folder, const CommonOptions& common) {
    const Result<Backend> backend = backend_of(options.backend);
    if (!backend) return failed(backend.error());
    ValidateOptions validate_options;
    validate_options.jobs = common.jobs;
    validate_options.keep_spirv = true;
    Validated validated = validate(family, composition, validate_options);
    if (exit_status(validated.diagnostics) != 0) return failed(std::move(validated.diagnostics));
    Result<verify::WitnessScene> scene = make_scene(world, family, validated, common.jobs);
    if (!scene) return failed(scene.error());
    verify::ShadowPass shadow_pass;
    if (has_shadows(family, composition)) {
        auto loaded = load_shadow_pass(world, common);
        if (!loaded) return failed(loaded.error());
        shadow_pass = std::move(*loaded);
        shadow_pass.pass.side = kMapSide;
        scene->shadow_pass = &shadow_pass;
    }
    const Result<Context> context = open_context(*backend);
    if (!context) return failed(context.error());
    const verify::WitnessReport report =
        verify::witness(*context, composition, validated, *scene, common.jobs);
    Outcome outcome;
    outcome.output = maps_text(report.shadow_maps, outcome.diagnostics);
    Totals totals;
    for (const verify::PictureReport& picture : report.pictures) {
        const std::string key = key_text(family, picture.key);
        Diagnostics problems = picture.diagnostics;
        for (Diagnostic& problem : problems) problem.subject = key;
        if (picture.fails()) problems = report_failure(world, folder, key, picture);
        outcome.diagnostics.insert(outcome.diagnostics.end(), problems.begin(), problems.end());
        add(picture, totals);
    }
    outcome.output += totals_text(totals, composition.permutations.size(), context->renderer());
    return outcome;
}

}  // namespace gobo
