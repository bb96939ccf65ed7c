// gobo test: evaluates every permutation of a selection and holds it against the oracle.
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "family/key.hpp"
#include "lab/commands/commands.hpp"
#include "lab/commands/shard.hpp"
#include "lab/commands/witness.hpp"
#include "lab/render/render.hpp"
#include "lab/verify/figures_json.hpp"
#include "lab/verify/test_meshes.hpp"
#include "lab/verify/verify.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct TestOptions {
    CommonOptions common;
    SelectionOptions selection;
    std::string family;
    std::string folder = "failed_points";
    std::string shard;
    std::string figures_file;
    WitnessOptions witness;
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

/// One error for the key, and a note for each of its worst points, which is written as a file.
Diagnostics report_failure(const World& world, const TestOptions& options, const std::string& key,
                           const verify::PermutationReport& report) {
    Diagnostic error;
    error.subject = key;
    error.message =
        fmt::format("{} of {} points are out of tolerance", report.failed_points, report.figures.points);
    error.help =
        fmt::format("follow one of these through the shader: gobo eval {} '{}' --inputs FILE --trace",
                    options.family, key);
    Diagnostics diagnostics = {std::move(error)};
    for (std::size_t i = 0; i < report.worst.size(); ++i) {
        const verify::Failure& failure = report.worst[i];
        Diagnostic note;
        note.severity = Severity::note;
        note.place.file =
            fmt::format("{}/{}", options.folder, file_name(key, failure.stage, std::to_string(i + 1)));
        note.message = fmt::format("{} stage: {}", name_of(failure.stage), to_text(failure));
        const Result<bool> written = world.disk.write(note.place.file, verify::eval_input(failure, key));
        if (!written) diagnostics.insert(diagnostics.end(), written.error().begin(), written.error().end());
        diagnostics.push_back(std::move(note));
    }
    return diagnostics;
}

/// Writes one side's worst point as an input of `gobo eval`, and says how to follow it.
Diagnostics report_side(const World& world, const TestOptions& options, const std::string& key,
                        const verify::BrokenPoint& broken, const evaluate::EvalPoint& point,
                        const std::string& file) {
    Diagnostic note;
    note.severity = Severity::note;
    note.place.file = fmt::format("{}/{}", options.folder, file);
    note.message = fmt::format("gobo eval {} '{}' --inputs this file", options.family, key);
    Diagnostics diagnostics = {note};
    const Result<bool> written = world.disk.write(
        note.place.file,
        evaluate::eval_file(name_of(broken.stage), point, "# " + key + "\n", evaluate::Digits::all));
    if (!written) diagnostics.insert(diagnostics.end(), written.error().begin(), written.error().end());
    return diagnostics;
}

/// One error at the relation, and a note for the worst point on either side.
Diagnostics report_broken_relation(const World& world, const TestOptions& options, const Family& family,
                                   const Key& key, const verify::RelationReport& report) {
    const Relation& relation = family.relations[report.relation];
    const std::string one = key_text(family, key);
    const auto partner = verify::partner_of(family, relation, key, name_of(Dialect::own));
    const std::string other = partner ? key_text(family, *partner) : one;
    Diagnostic error;
    error.subject = one;
    error.place = relation.place;
    error.message =
        fmt::format("the relation {} does not hold at {} of {} points: {}",
                    to_text(relation, family.features), report.failed, report.points, report.found);
    error.help = "fix the shaders, or state `when` it holds";
    Diagnostics diagnostics = {std::move(error)};
    if (!report.worst) return diagnostics;
    const auto add = [&](const std::string& side_key, const evaluate::EvalPoint& point, const char* side) {
        const std::string file =
            file_name(one, report.worst->stage, fmt::format("relation_{}.{}", report.relation + 1, side));
        const Diagnostics more = report_side(world, options, side_key, *report.worst, point, file);
        diagnostics.insert(diagnostics.end(), more.begin(), more.end());
    };
    add(one, report.worst->one, "one");
    add(other, report.worst->other, "other");
    return diagnostics;
}

Diagnostics report_failures(const World& world, const TestOptions& options, const Family& family,
                            const verify::VerifyReport& report) {
    Diagnostics diagnostics;
    const auto add = [&](const Diagnostics& more) {
        diagnostics.insert(diagnostics.end(), more.begin(), more.end());
    };
    for (const verify::PermutationReport& permutation : report.permutations) {
        add(permutation.diagnostics);
        if (permutation.failed_points > 0)
            add(report_failure(world, options, key_text(family, permutation.key), permutation));
        for (const verify::RelationReport& relation : permutation.relations)
            if (relation.failed > 0)
                add(report_broken_relation(world, options, family, permutation.key, relation));
    }
    const verify::Figures& figures = report.figures;
    if (static_cast<double>(figures.edges) >
        verify::kLargestEdgeShare * static_cast<double>(figures.points)) {
        add(fail(Fault::input, fmt::format("{} of {} points lie at a discontinuity: more than 1 %",
                                           figures.edges, figures.points))
                .value());
    }
    return diagnostics;
}

/// "12 permutations of 8640 valid ones".
Result<std::string> size_text(const Family& family, std::size_t tested, Dialect dialect) {
    Selection everything;
    everything.all = true;
    const Result<std::uint64_t> valid = count_selected(family, everything, name_of(dialect));
    if (!valid) return tl::unexpected(valid.error());
    return fmt::format("{} permutations of {} valid ones", tested, *valid);
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
    text += relations_text(report);
    text += fmt::format("fp32: at most {:.2f} of the error bound\n", figures.largest_fp32_ratio);
    text += fmt::format(
        "{} permutations, {} points, {} ({:.3f} %) at a discontinuity, {} permutations without an "
        "oracle\n",
        report.permutations.size(), figures.points, figures.edges, edge_share, report.without_oracle);
    return text;
}

/// The permutations to test, and behind them those that relations compare them with.
struct Subjects {
    Composition composition;
    std::size_t partners = 0;
};

Result<Subjects> compose_shard(const World& world, LoadedFamily& family, const TestOptions& options) {
    Result<std::vector<Key>> keys = load_keys(world, family, options.selection, Dialect::own);
    if (!keys) return tl::unexpected(keys.error());
    keys = shard_of(std::move(*keys), options.shard);
    if (!keys) return tl::unexpected(keys.error());
    const std::vector<Key> more = options.witness.render
                                      ? std::vector<Key>{}
                                      : verify::partners(family.family, *keys, name_of(Dialect::own));
    keys->insert(keys->end(), more.begin(), more.end());
    Result<Composition> composition = compose(family.family, *keys, family.search, Dialect::own);
    if (!composition) return tl::unexpected(composition.error());
    return Subjects{std::move(*composition), more.size()};
}

Outcome run(const TestOptions& options, const World& world) {
    Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const Result<Subjects> subjects = compose_shard(world, *family, options);
    if (!subjects) return failed(subjects.error());
    const Composition* composition = &subjects->composition;
    if (options.witness.render)
        return run_witness(world, options.witness, family->family, *composition, options.folder,
                           options.common);
    ValidateOptions validate_options;
    validate_options.jobs = options.common.jobs;
    validate_options.keep_spirv = true;
    Validated validated = validate(family->family, *composition, validate_options);
    if (exit_status(validated.diagnostics) != 0) return failed(std::move(validated.diagnostics));
    verify::VerifyOptions verify_options;
    verify_options.jobs = options.common.jobs;
    verify_options.partners = subjects->partners;
    Result<Mesh> teapot = read_obj(world.shipped, "data/meshes/teapot.obj");
    if (!teapot) return failed(teapot.error());
    verify_options.meshes = verify::test_meshes(std::move(*teapot));
    const verify::VerifyReport report =
        verify::verify(family->family, *composition, validated, verify_options);
    const Result<std::string> size = size_text(family->family, report.permutations.size(), Dialect::own);
    if (!size) return failed(size.error());
    Diagnostics diagnostics = report_failures(world, options, family->family, report);
    if (!options.figures_file.empty()) {
        const Result<bool> written =
            world.disk.write(options.figures_file, verify::figures_json(family->family, report));
        if (!written) diagnostics.insert(diagnostics.end(), written.error().begin(), written.error().end());
    }
    return {*size + "\n" + figures_text(report), std::move(diagnostics), {}};
}

}  // namespace

Command test_command(CLI::App& gobo) {
    auto options = std::make_shared<TestOptions>();
    CLI::App* app = gobo.add_subcommand("test", "Evaluate every permutation and hold it against the oracle");
    app->add_option("FAMILY", options->family, "A shipped family or a .toml file")->required();
    add_selection_options(*app, options->selection);
    app->add_option(
           "-o,--output", options->folder,
           "Folder for the worst points of failing keys, as input files of gobo eval, or their pictures")
        ->type_name("FOLDER")
        ->capture_default_str();
    app->add_option("--shard", options->shard, "Only every N-th key, from the I-th on")->type_name("I/N");
    app->add_option("--figures", options->figures_file,
                    "Write each key's points and largest errors to this file, as JSON")
        ->type_name("FILE")
        ->excludes(add_witness_options(*app, options->witness));
    add_common_options(*app, options->common);
    app->footer(
        "The stages are evaluated in fp32 and fp64 over points made to exercise each model. Families of your "
        "own\n"
        "have no oracle: there fp32 is held against fp64.\n\n"
        "Examples:\n"
        "  gobo test lit                               the family's default set\n"
        "  gobo test lit --cover 3\n"
        "  gobo test lit --cover 2 --render            every key drawn, too\n"
        "  gobo test lit --figures figures.json\n"
        "  gobo test lit --key 'fog=linear point=3' -I my_pieces\n"
        "  gobo test game.toml -o build/failed_points");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
