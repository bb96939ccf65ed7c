// gobo test --render: what the renderer draws, compared with the evaluation pixel by pixel.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "family/key.hpp"
#include "lab/commands/commands.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/render/image_file.hpp"
#include "lab/render/render.hpp"
#include "lab/verify/cross_check.hpp"

namespace gobo {
namespace {

constexpr int kSide = 64;

/// A difference of this much is white in the picture of differences.
constexpr float kWhiteDifference = 1e-3F;

/// The side of a shadow map: coarse, so that many edges of its texels are seen.
constexpr int kMapSide = 64;

Diagnostics report_failure(const World& world, const std::string& folder, const std::string& key,
                           const raster::PictureReport& report) {
    Diagnostic error;
    error.subject = key;
    error.message =
        fmt::format("{} of {} pixels are not what the evaluation gives, {} at an edge, rms {:.1e}",
                    report.wrong, report.pixels, report.edges, report.root_mean_square);
    for (const raster::WrongPixel& pixel : report.worst)
        error.message +=
            fmt::format("\n  pixel ({}, {}): drawn {:.7g}, evaluated {:.7g}, {:.3g} times the limit", pixel.x,
                        pixel.y, fmt::join(pixel.actual, " "), fmt::join(pixel.expected, " "), pixel.ratio);
    if (folder.empty()) {
        error.help = "keep what is drawn, expected and their difference with -o DIR";
        return {error};
    }
    const std::string stem = fmt::format("{}/{}", folder, picture_name(key));
    error.help = fmt::format("see {}.actual.exr, .expected.exr and .difference.png", stem);
    Diagnostics diagnostics = {std::move(error)};
    const auto keep = [&](const char* end, const Image& image) {
        if (const auto written = write_image(world.disk, stem + end, image); !written)
            append(diagnostics, written.error());
    };
    keep(".actual.exr", report.actual);
    keep(".expected.exr", report.expected);
    keep(".difference.png", difference_picture(report.actual, report.expected, kWhiteDifference));
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

void add(const raster::PictureReport& picture, Totals& totals) {
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
    append(diagnostics, report->diagnostics);
    if (report->fails()) {
        const std::string message =
            fmt::format("{} of the {} texels of shadow maps are not what the evaluation gives, {} at an edge",
                        report->wrong, report->texels, report->edges);
        append(diagnostics, fail(Fault::input, message).value());
    }
    return fmt::format(
        "{} shadow maps of {} x {} texels, {} decided at an edge; at most {:.2f} of the limit\n",
        report->maps, kMapSide, kMapSide, report->edges, report->largest_ratio);
}

}  // namespace

Result<Outcome> compare_pictures(const World& world, const TestOptions& options, const Family& family,
                                 const Composition& composition, const Validated& validated) {
    GOBO_TRY(const Backend backend, backend_of(options.backend));
    GOBO_TRY(Mesh teapot, load_mesh(world, "teapot"));
    verify::CrossCheckScene scene;  // what gobo render shows, smaller
    scene.objects = demo_objects(std::move(teapot));
    scene.values = family.render;
    scene.family = &family;
    scene.view.camera = demo_camera();
    scene.view.width = scene.view.height = kSide;
    GOBO_TRY(scene.cubes, load_environment(world, "", interfaces_of(composition, validated)));
    GOBO_TRY(auto shadow_pass, load_shadow_pass(world, family, composition));
    if (shadow_pass) {
        shadow_pass->pass.side = kMapSide;
        scene.shadow_pass = &*shadow_pass;
    }
    GOBO_TRY(const Context context, open_context(backend));
    const auto report = verify::cross_check(context, composition, validated, scene, world.jobs());
    Outcome outcome;
    outcome.output = maps_text(report.shadow_maps, outcome.diagnostics);
    Totals totals;
    for (const raster::PictureReport& picture : report.pictures) {
        const std::string key = key_text(family, picture.key);
        Diagnostics problems = picture.diagnostics;
        for (Diagnostic& problem : problems) problem.subject = key;
        if (picture.fails()) problems = report_failure(world, options.folder, key, picture);
        append(outcome.diagnostics, problems);
        add(picture, totals);
    }
    outcome.output += totals_text(totals, composition.permutations.size(), context.renderer());
    return outcome;
}

}  // namespace gobo
