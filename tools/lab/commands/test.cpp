// gobo test: evaluates every permutation of a selection and compares it with the oracle; with --render, what
// the renderer draws with the evaluation, pixel by pixel.
#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "gobo/shard_text.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/render/render.hpp"
#include "lab/verify/cross_check.hpp"
#include "lab/verify/on_mesh.hpp"
#include "lab/verify/stage_check.hpp"
#include "lab/verify/verify.hpp"

namespace gobo {
namespace {

struct TestOptions : SelectionOptions {
    std::string folder;  ///< for the worst points of keys that fail; empty: they are not kept
    std::string figures_file;
    bool render = false;
    std::string backend = "osmesa";
};

/// A file name of letters, digits and '_' for a key.
std::string file_name(const std::string& key, StageKind stage, const std::string& point) {
    std::string name;
    for (const char character : key)
        name += std::isalnum(static_cast<unsigned char>(character)) ? character : '_';
    // File systems take 255 bytes; the end of the picture's name tells keys apart that begin alike.
    if (name.size() > 200) name = name.substr(0, 183) + "_" + picture_name(key).substr(184);
    return fmt::format("{}.{}.{}.toml", name, name_of(stage), point);
}

/// A note for a point that failed, at the file that keeps it.
Diagnostics keep_point(const World& world, const TestOptions& options, const std::string& file,
                       const std::string& input, const std::string& message) {
    if (options.folder.empty()) return {note_in("", message)};
    const std::string path = fmt::format("{}/{}", options.folder, file);
    Diagnostics diagnostics = keep_file(world, path, input);
    diagnostics.push_back(note_in(path, message));
    return diagnostics;
}

/// One error for the key, and a note for each of its worst points.
Diagnostics report_failure(const World& world, const TestOptions& options, const std::string& key,
                           const verify::PermutationReport& report) {
    Diagnostics diagnostics =
        fail(Fault::input,
             fmt::format("{} of {} points are out of tolerance", report.failed_points, report.figures.points),
             fmt::format("{}follow one of {} through the shader: gobo eval {} '{}' --inputs FILE --trace",
                         options.folder.empty() ? "keep the worst points with -o DIR, and " : "",
                         options.folder.empty() ? "them" : "these", shell_word(options.family), key))
            .value();
    diagnostics.front().subject = key;
    for (std::size_t i = 0; i < report.worst.size(); ++i) {
        const verify::Failure& failure = report.worst[i];
        append(diagnostics,
               keep_point(world, options, file_name(key, failure.stage, std::to_string(i + 1)),
                          verify::eval_input(failure, key),
                          fmt::format("{} stage: {}", name_of(failure.stage), to_text(failure))));
    }
    return diagnostics;
}

/// One error for the key whose formula loses what its inputs have, and a note for the worst point.
Diagnostics report_unexplained(const World& world, const TestOptions& options, const std::string& key,
                               const verify::PermutationReport& report) {
    const verify::Failure& failure = *report.least_explained;
    Diagnostics diagnostics =
        fail(
            Fault::input,
            fmt::format(
                "{} of {} points err by more than {} roundings of their inputs explain: a formula loses them",
                report.figures.unexplained, report.figures.points, verify::kConditionFactor),
            fmt::format("compare its operations in fp32 and fp64: gobo eval {} '{}' --inputs FILE --trace{}",
                        shell_word(options.family), key,
                        options.folder.empty() ? "; keep the worst point with -o DIR" : ""))
            .value();
    diagnostics.front().subject = key;
    append(diagnostics, keep_point(world, options, file_name(key, failure.stage, "unexplained"),
                                   verify::eval_input(failure, key),
                                   fmt::format("{} stage: {}", name_of(failure.stage), to_text(failure))));
    return diagnostics;
}

/// One error at the relation, and a note for the worst point on either side.
Diagnostics report_broken_relation(const World& world, const TestOptions& options, const Family& family,
                                   Dialect dialect, const Key& key, const verify::RelationReport& report) {
    const Relation& relation = family.relations[report.relation];
    const std::string one = key_text(family, key);
    const auto partner = verify::partner_of(family, relation, key, name_of(dialect));
    Diagnostic error;
    error.subject = one;
    error.place = relation.place;
    error.message = fmt::format("the relation {} does not hold at {} of {} points: {}", relation.text,
                                report.failed, report.points, report.found);
    error.help = fmt::format("fix the shaders, or state `when` it holds{}",
                             options.folder.empty() ? "; keep the worst point with -o DIR" : "");
    Diagnostics diagnostics = {std::move(error)};
    const auto keep = [&](const std::string& side_key, const evaluate::EvalPoint& point, const char* side) {
        append(
            diagnostics,
            keep_point(
                world, options,
                file_name(one, report.worst->stage, fmt::format("relation_{}.{}", report.relation + 1, side)),
                evaluate::eval_file(name_of(report.worst->stage), point, {side_key}, evaluate::Digits::all),
                fmt::format("gobo eval {} '{}' --inputs this file", shell_word(options.family), side_key)));
    };
    if (!report.worst || options.folder.empty()) return diagnostics;
    keep(one, report.worst->one, "one");
    keep(partner ? key_text(family, *partner) : one, report.worst->other, "other");
    return diagnostics;
}

Diagnostics report_failures(const World& world, const TestOptions& options, const Family& family,
                            Dialect dialect, const verify::VerifyReport& report) {
    Diagnostics diagnostics;
    for (const verify::PermutationReport& permutation : report.permutations) {
        append(diagnostics, permutation.diagnostics);
        if (permutation.failed_points > 0)
            append(diagnostics,
                   report_failure(world, options, key_text(family, permutation.key), permutation));
        if (permutation.least_explained)
            append(diagnostics,
                   report_unexplained(world, options, key_text(family, permutation.key), permutation));
        for (const verify::RelationReport& relation : permutation.relations)
            if (relation.failed > 0)
                append(diagnostics,
                       report_broken_relation(world, options, family, dialect, permutation.key, relation));
    }
    const verify::Figures& figures = report.figures;
    if (static_cast<double>(figures.edges) > verify::kLargestEdgeShare * static_cast<double>(figures.points))
        append(diagnostics,
               fail(Fault::input, fmt::format("{} of {} points lie at a discontinuity: more than 1 %",
                                              figures.edges, figures.points))
                   .value());
    return diagnostics;
}

/// "3 relations tried at 1920 points"; nothing where none was.
std::string relations_text(const verify::VerifyReport& report) {
    std::set<std::size_t> tried;
    std::size_t points = 0;
    for (const verify::PermutationReport& permutation : report.permutations)
        for (const verify::RelationReport& relation : permutation.relations) {
            tried.insert(relation.relation);
            points += relation.points;
        }
    if (tried.empty()) return {};
    return fmt::format("{} relation{} tried at {} points\n", tried.size(), tried.size() == 1 ? "" : "s",
                       points);
}

std::string figures_text(const verify::VerifyReport& report) {
    const verify::Figures& figures = report.figures;
    const double edge_share =
        figures.points > 0 ? 100.0 * static_cast<double>(figures.edges) / static_cast<double>(figures.points)
                           : 0;
    std::string text;
    if (report.without_oracle < report.permutations.size())
        text += fmt::format(
            "{} of the points on rasterised meshes\n"
            "fp64: at most {:.1e} of the largest term away from the oracle\n",
            report.points_on_meshes, figures.largest_fp64_error);
    if (report.points_of_laws > 0)
        text += fmt::format("furnace, reciprocity, mirror image and metal tried at {} points\n",
                            report.points_of_laws);
    text += relations_text(report);
    text += fmt::format("fp32: at most {:.2f} of the error bound\n", figures.largest_fp32_ratio);
    if (report.without_oracle < report.permutations.size())
        text += fmt::format(
            "fp32: at {} points the bound is above the value, at {} of them above {} of the light\n",
            figures.vacuous, figures.loose, verify::kLooseBound);
    text += fmt::format(
        "{} permutations, {} points, {} ({:.3f} %) at a discontinuity, {} permutations without an "
        "oracle\n",
        report.permutations.size(), figures.points, figures.edges, edge_share, report.without_oracle);
    return text;
}

constexpr int kSide = 64;

/// A difference of this much is white in the picture of differences.
constexpr float kWhiteDifference = 1e-3F;

/// The side of a shadow map: coarse, so that many edges of its texels are seen.
constexpr int kMapSide = 64;

Diagnostics report_picture(const World& world, const std::string& folder, const std::string& key,
                           const raster::PictureReport& report) {
    Diagnostic error;
    error.subject = key;
    const bool cannot_be_judged = report.wrong == 0 && report.root_mean_square <= raster::kRmsLimit;
    error.message =
        cannot_be_judged
            ? fmt::format(
                  "{} of {} pixels lie at an edge, or where surfaces are as deep as others: too many "
                  "to judge the picture by the rest, which is right",
                  report.edges, report.pixels)
            : fmt::format("{} of {} pixels are not what the evaluation gives, {} at an edge, rms {:.1e}",
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
            append(diagnostics, as_warnings(written.error()));
    };
    keep(".actual.exr", report.actual);
    keep(".expected.exr", report.expected);
    keep(".difference.png", difference_picture(report.actual, report.expected, kWhiteDifference));
    return diagnostics;
}

/// `totals` are of all pictures together.
std::string totals_text(const raster::PictureReport& totals, std::size_t drawn, std::size_t permutations,
                        const std::string& renderer) {
    const auto share = [&](std::size_t part) {
        return totals.pixels > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(totals.pixels) : 0;
    };
    return fmt::format(
        "{} x {} pixels: {:.1f} % drawn, {} ({:.3f} %) decided at an edge; at most {:.2f} of the limit\n"
        "{}{} permutations drawn{}, max {:.1e}, rms {:.1e}\n",
        kSide, kSide, share(totals.drawn), totals.edges, share(totals.edges), totals.largest_ratio,
        drawn < permutations ? fmt::format("{} of ", drawn) : "", permutations,
        renderer.empty() ? "" : " by " + renderer, totals.largest_error, totals.root_mean_square);
}

/// What there is to say of a picture that passes: its values, and an error where it shows nothing.
Diagnostics warnings_of(const raster::PictureReport& picture) {
    Diagnostics warnings = picture.warnings;
    if (picture.drawn > 0 || !picture.diagnostics.empty()) return warnings;
    warnings.push_back(
        {.message = "no pixel is drawn, so nothing was compared",
         .help = "give what gl_Position is computed from its values under [render] in the family file"});
    return warnings;
}

/// The largest of each error, the worst root mean square, all pixels.
void add(const raster::PictureReport& picture, raster::PictureReport& totals) {
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

/// gobo test --render: draws every permutation and compares each picture with its evaluation. A picture that
/// fails is an error for its key, and three images in the folder. `validated` holds the SPIR-V of every
/// stage.
Result<Outcome> compare_pictures(const World& world, const TestOptions& options, const Family& family,
                                 const Composition& composition, const Validated& validated) {
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
    std::optional<Backend> opengl;
    if (options.backend != kVulkanBackend) {
        GOBO_TRY(opengl, backend_of(options.backend));
    }
    GOBO_TRY(const verify::CrossCheckReport report,
             verify::cross_check("the renderer of --backend " + options.backend, opengl, composition,
                                 validated, scene, world.jobs()));
    Outcome outcome;
    outcome.output = maps_text(report.shadow_maps, outcome.diagnostics);
    raster::PictureReport totals;
    std::size_t drawn = 0;
    DiagnosticGroups undrawn(family);
    DiagnosticGroups warnings(family);
    for (std::size_t i = 0; i < report.pictures.size(); ++i) {
        const raster::PictureReport& picture = report.pictures[i];
        const std::string key = key_text(family, picture.key);
        if (std::ranges::count(report.crashed, i) > 0)
            append(outcome.diagnostics,
                   with_kept_stages(world, options.folder, family, composition, validated,
                                    composition.permutations[i], picture.diagnostics));
        else
            for (const Diagnostic& problem : picture.diagnostics) undrawn.add(problem, picture.key);
        if (picture.fails()) append(outcome.diagnostics, report_picture(world, options.folder, key, picture));
        for (const Diagnostic& warning : warnings_of(picture)) warnings.add(warning, picture.key);
        if (picture.diagnostics.empty()) ++drawn;
        add(picture, totals);
    }
    append(outcome.diagnostics, undrawn.result());
    append(outcome.diagnostics, warnings.result());
    append(outcome.diagnostics, warn_of_no_keys(composition, "nothing was tested"));
    outcome.output += totals_text(totals, drawn, composition.permutations.size(), report.renderer);
    return outcome;
}

Result<Outcome> run(const TestOptions& options, const World& world) {
    GOBO_TRY(const std::string dialect, options.render ? dialect_for(options.backend, options.dialect)
                                                       : Result<std::string>(options.dialect));
    GOBO_TRY(LoadedFamily family, load_family(world, options.family, dialect));
    // Evaluated are the literal counts: drivers make the same code of both (gobo cost --specialized).
    if (!options.render) make_counts_literal(family.family);
    GOBO_TRY(std::vector<Key> keys, load_keys(world, family, options));
    verify::VerifyOptions verify_options;
    if (!options.render) {  // behind the keys stand those that relations compare them with
        const auto partners = verify::partners(family.family, keys, name_of(family.dialect));
        keys.insert(keys.end(), partners.begin(), partners.end());
        verify_options.partners = partners.size();
    }
    GOBO_TRY(Composition composition, compose_keys(family, keys));
    GOBO_TRY_DO(refuse_other_stages(family.family, composition, "gobo test evaluates", options.render));
    GOBO_TRY(const Validated validated, compile(world, family, composition, {.keep_spirv = true}));
    if (options.render) return compare_pictures(world, options, family.family, composition, validated);
    if (!options.figures_file.empty()) GOBO_TRY_DO(world.refuse_inputs({options.figures_file}));
    verify_options.jobs = world.jobs();
    GOBO_TRY(Mesh teapot, load_mesh(world, "teapot"));
    verify_options.meshes = verify::test_meshes(std::move(teapot));
    const auto report = verify::verify(family.family, composition, validated, verify_options);
    GOBO_TRY(const auto valid, count_selected(family.family, {.all = true}, name_of(family.dialect)));
    Diagnostics diagnostics = report_failures(world, options, family.family, family.dialect, report);
    append(diagnostics, warn_of_no_keys(composition, "nothing was tested"));
    if (!options.figures_file.empty()) {
        const auto written = world.disk.write(
            options.figures_file,
            text_of_shard(verify::figures_json(family.family, report), options.shard, family.run));
        if (!written) append(diagnostics, written.error());
    }
    return Outcome{
        fmt::format("{} permutations of {} valid ones\n", report.permutations.size(), valid.text()) +
            figures_text(report),
        std::move(diagnostics)};
}

}  // namespace

Command test_command() {
    const auto options = std::make_shared<TestOptions>();
    return {titles::kTest,
            {family_argument(options->family),
             keep_option(options->folder,
                         "the worst points of keys that fail, as inputs of gobo eval, or their pictures,"),
             {"--render", "", "Draw every key instead, 64 x 64, and compare each pixel with the evaluation",
              &options->render},
             {"--figures",
              "FILE",
              "Write each key's points and largest errors to this file, as JSON",
              &options->figures_file,
              {.excludes = "--render"}},
             {"--backend", kBackends, "What draws", &options->backend, {.needs = "--render"}},
             dialect_option(options->dialect)},
            {selection_options(*options)},
            "  gobo test lit                               the family's default set\n"
            "  gobo test lit --cover 3\n"
            "  gobo test lit --cover 2 --render            every key drawn, too\n"
            "  gobo test lit --cover 2 --render --backend vulkan\n"
            "  gobo test lit --dialect es300\n"
            "  gobo test lit --figures figures.json\n"
            "  gobo test lit --key 'fog=linear point=3' -I my_pieces\n"
            "  gobo test game.toml -o build/failed_points",
            [options](const World& world) { return run(*options, world); },
            "The stages are evaluated in fp32 and fp64 at points made to exercise each model. Families of "
            "your own have no oracle, a second implementation of the models: there fp32 is compared with "
            "fp64."};
}

}  // namespace gobo
