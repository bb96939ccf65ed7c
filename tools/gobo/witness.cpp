#include "gobo/witness.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "family/key.hpp"
#include "render/render_selection.hpp"
#include "validate/validate.hpp"
#include "verify/witness.hpp"

namespace gobo {
namespace {

constexpr int kSide = 64;

/// A difference of this much is white in the picture of differences.
constexpr float kWhiteDifference = 1e-3F;

/// The scene that `gobo render` shows, smaller: at this size interpolation in floats is known to be exact
/// enough (verify::kInterpolationError).
Result<verify::WitnessScene> make_scene(const World& world, const Family& family) {
    Result<Mesh> teapot = read_obj(world.shipped, "data/meshes/teapot.obj");
    if (!teapot) return tl::unexpected(teapot.error());
    verify::WitnessScene scene;
    scene.objects = demo_objects(std::move(*teapot));
    scene.values = family.render;
    scene.family = &family;
    scene.view.camera = demo_camera();
    scene.view.width = scene.view.height = kSide;
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
    error.remedy = fmt::format("see {}.actual.exr, .expected.exr and .difference.png", stem);
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
                    const Composition& composition, const std::string& folder, int jobs) {
    const Result<Backend> backend = backend_of(options.backend);
    if (!backend) return failed(backend.error());
    const Result<verify::WitnessScene> scene = make_scene(world, family);
    if (!scene) return failed(scene.error());
    ValidateOptions validate_options;
    validate_options.jobs = jobs;
    validate_options.keep_spirv = true;
    Validated validated = validate(family, composition, validate_options);
    if (exit_status(validated.diagnostics) != 0) return failed(std::move(validated.diagnostics));
    const Result<Context> context = open_context(*backend);
    if (!context) return failed(context.error());
    Outcome outcome;
    Totals totals;
    for (const verify::PictureReport& report :
         verify::witness(*context, composition, validated, *scene, jobs)) {
        const std::string key = key_text(family, report.key);
        Diagnostics problems = report.diagnostics;
        for (Diagnostic& problem : problems) problem.subject = key;
        if (report.fails()) problems = report_failure(world, folder, key, report);
        outcome.diagnostics.insert(outcome.diagnostics.end(), problems.begin(), problems.end());
        totals.largest_error = std::max(totals.largest_error, report.largest_error);
        totals.root_mean_square = std::max(totals.root_mean_square, report.root_mean_square);
        totals.largest_ratio = std::max(totals.largest_ratio, report.largest_ratio);
        totals.pixels += report.pixels;
        totals.drawn += report.drawn;
        totals.edges += report.edges;
    }
    outcome.output = totals_text(totals, composition.permutations.size(), context->renderer());
    return outcome;
}

}  // namespace gobo
