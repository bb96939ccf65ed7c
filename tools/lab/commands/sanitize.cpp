// gobo sanitize: runs every stage of a selection, or loose GLSL files, on hard inputs, with each operation
// watched.
#include "lab/sanitize/sanitize.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/search_path.hpp"
#include "family/key.hpp"
#include "family/read_domains.hpp"
#include "lab/commands/commands.hpp"
#include "lab/sanitize/precision_report.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct SanitizeCommandOptions {
    CommonOptions common;
    SelectionOptions selection;
    std::vector<std::string> names;  ///< FAMILY, or files
    std::string folder = "failed_points";
    std::size_t points = 2048;
    std::size_t total = 0;
    std::uint64_t seed = 1;
    std::size_t guided = 0;
    double minutes = 0;
    std::string inputs;  ///< a file of domains
    bool rounding = false;
    bool json = false;
    std::vector<std::string> machines = {"ieee", "flushed"};
};

struct Subject {
    Family family;
    Composition composition;
    bool is_files = false;
};

Result<Subject> subject_of_files(const SanitizeCommandOptions& options, const World& world) {
    SearchPath search;
    for (const std::string& folder : options.common.include_folders) search.add(world.disk, folder, "", true);
    Result<Family> family = family_of_files(options.names, world.disk, search);
    if (!family) return tl::unexpected(family.error());
    Result<Composition> composition = compose(*family, {Key{}}, search, Dialect::own);
    if (!composition) return tl::unexpected(composition.error());
    return Subject{std::move(*family), std::move(*composition), true};
}

Result<Subject> subject_of(const SanitizeCommandOptions& options, const World& world) {
    if (std::any_of(options.names.begin(), options.names.end(), is_shader_file))
        return subject_of_files(options, world);
    if (options.names.size() > 1) {
        return fail(Fault::usage, fmt::format("'{}' is one name too many", options.names[1]),
                    "name one family, or shader files; keys are named with --key");
    }
    Result<LoadedFamily> family = load_family(world, options.names[0], options.common);
    if (!family) return tl::unexpected(family.error());
    Result<Composition> composition = load_composition(world, *family, options.selection, Dialect::own);
    if (!composition) return tl::unexpected(composition.error());
    return Subject{std::move(family->family), std::move(*composition), false};
}

/// The text of the piece that a place names.
std::string quoted_line(const Composition& composition, const Place& place) {
    const auto piece = std::find_if(composition.pieces.begin(), composition.pieces.end(),
                                    [&](const Piece& other) { return other.path == place.file; });
    return piece == composition.pieces.end() ? "" : std::string(line_of(*piece, place.line));
}

/// "1.linear.glsl.15.toml": the last part of the place's path, and its line.
std::string file_name(const sanitize::Finding& finding, std::size_t number) {
    const std::string& path = finding.place.file;
    return fmt::format("{}.{}.{}.toml", number, path.substr(path.rfind('/') + 1), finding.place.line);
}

std::string shared_text(const Subject& subject, const sanitize::SharedFinding& shared) {
    if (subject.is_files) return fmt::format("{} points", shared.finding.points);
    return fmt::format("{} points, {} keys", shared.finding.points, shared.permutations.size());
}

/// The command that shows the finding step by step.
std::string follow_text(const SanitizeCommandOptions& options, const std::string& key,
                        const std::string& path) {
    if (key.empty())
        return fmt::format("gobo eval {} --inputs {} --trace", fmt::join(options.names, " "), path);
    return fmt::format("gobo eval {} '{}' --inputs {} --trace", options.names[0], key, path);
}

/// The finding as an error, and its example as an input file.
Diagnostics report(const World& world, const SanitizeCommandOptions& options, const Subject& subject,
                   const sanitize::SharedFinding& shared, std::size_t number) {
    Diagnostics diagnostics;
    const sanitize::Finding& finding = shared.finding;
    Diagnostic& error = diagnostics.emplace_back();
    error.place = finding.place;
    error.quoted_line = quoted_line(subject.composition, finding.place);
    error.message = fmt::format("{} ({})", to_text(finding), shared_text(subject, shared));
    if (!subject.is_files && !shared.permutations.empty()) {
        const std::size_t first = shared.permutations.front();
        error.subject = key_text(subject.family, subject.composition.permutations[first].key);
    }
    const std::string path = fmt::format("{}/{}", options.folder, file_name(finding, number));
    const std::string follow = follow_text(options, error.subject, path);
    const Result<bool> written = world.disk.write(path, sanitize::eval_input(finding, follow));
    error.help = "guard the operation; follow the input with: " + follow;
    if (!written) diagnostics.insert(diagnostics.end(), written.error().begin(), written.error().end());
    return diagnostics;
}

std::string counts_text(const Subject& subject, std::size_t machines, const sanitize::SanitizeReport& found) {
    return fmt::format("{} permutations, {} stages, {} points on {} machines, {} findings\n",
                       subject.composition.permutations.size(), found.stages, found.points, machines,
                       found.findings.size());
}

std::vector<std::string> machine_names() {
    std::vector<std::string> names = {"all"};
    for (const sanitize::Machine machine : sanitize::kMachines) names.emplace_back(name_of(machine));
    return names;
}

/// The names have been checked when the command line was read.
std::vector<sanitize::Machine> machines_of(const SanitizeCommandOptions& options) {
    std::vector<sanitize::Machine> machines;
    for (const std::string& name : options.machines)
        if (name == "all")
            machines.assign(std::begin(sanitize::kMachines), std::end(sanitize::kMachines));
        else if (const auto machine = sanitize::machine_named(name))
            machines.push_back(*machine);
    return machines;
}

/// Domains of the file named with --inputs.
Result<std::vector<Domain>> narrower_domains(const SanitizeCommandOptions& options, const World& world) {
    if (options.inputs.empty()) return std::vector<Domain>{};
    const Result<std::string> text = read_input(world, options.inputs);
    if (!text) return tl::unexpected(text.error());
    return read_domain_file(*text, options.inputs);
}

/// They stand ahead of the family's own.
void put_first(const std::vector<Domain>& domains, Family& family) {
    family.domains.insert(family.domains.begin(), domains.begin(), domains.end());
}

sanitize::SanitizeOptions options_of(const SanitizeCommandOptions& options) {
    sanitize::SanitizeOptions result;
    result.jobs = options.common.jobs;
    result.points = options.points;
    result.total = options.total;
    result.seed = options.seed;
    result.guided = options.guided;
    result.minutes = options.minutes;
    result.machines = machines_of(options);
    return result;
}

Outcome report_rounding(const SanitizeCommandOptions& options, const Subject& subject,
                        const Validated& validated) {
    const auto stages =
        sanitize::measure_precision(subject.family, subject.composition, validated, options_of(options));
    if (!stages) return failed(stages.error());
    return {options.json ? sanitize::precision_json(*stages) : sanitize::precision_text(*stages), {}, {}};
}

Outcome run(const SanitizeCommandOptions& options, const World& world) {
    Result<Subject> subject = subject_of(options, world);
    if (!subject) return failed(subject.error());
    const Result<std::vector<Domain>> narrower = narrower_domains(options, world);
    if (!narrower) return failed(narrower.error());
    put_first(*narrower, subject->family);
    ValidateOptions validate_options;
    validate_options.jobs = options.common.jobs;
    validate_options.keep_spirv = true;
    validate_options.debug_information = true;
    Validated validated = validate(subject->family, subject->composition, validate_options);
    if (exit_status(validated.diagnostics) != 0) return failed(std::move(validated.diagnostics));
    if (Diagnostics errors = sanitize::domains_of_nothing(*narrower, validated); !errors.empty())
        return failed(std::move(errors));
    if (options.rounding) return report_rounding(options, *subject, validated);
    const sanitize::SanitizeOptions sanitize_options = options_of(options);
    const sanitize::SanitizeReport found =
        sanitize::sanitize(subject->family, subject->composition, validated, sanitize_options);
    Diagnostics diagnostics = found.diagnostics;
    for (std::size_t i = 0; i < found.findings.size(); ++i) {
        const Diagnostics more = report(world, options, *subject, found.findings[i], i + 1);
        diagnostics.insert(diagnostics.end(), more.begin(), more.end());
    }
    return {counts_text(*subject, sanitize_options.machines.size(), found), std::move(diagnostics), {}};
}

}  // namespace

Command sanitize_command(CLI::App& gobo) {
    auto options = std::make_shared<SanitizeCommandOptions>();
    CLI::App* app = gobo.add_subcommand(
        "sanitize", "Watch every operation on hard inputs for what GLSL leaves undefined");
    app->add_option("NAMES", options->names,
                    "A family, or shader files (.vert, .frag, .vert.glsl, .frag.glsl)")
        ->required()
        ->type_name("FAMILY|FILES...");
    add_selection_options(*app, options->selection);
    app->add_option("--points", options->points, "Hard inputs of each distinct stage")->capture_default_str();
    app->add_option("--total", options->total, "Instead, at least so many over all stages");
    app->add_option("--seed", options->seed, "Another seed tries other inputs")->capture_default_str();
    app->add_option("--guided", options->guided,
                    "Then so many inputs made of those that reached a new branch or came nearest to a trap")
        ->capture_default_str();
    app->add_option("--minutes", options->minutes, "Go on with such inputs until so long has passed")
        ->check(CLI::NonNegativeNumber);
    app->add_option("--machine", options->machines,
                    "What to run on, each a liberty of GLSL: ieee; flushed (denormals are 0); nan_kept, "
                    "nan_dropped (by min, max, clamp); fused (a * b + c); regrouped, reordered (sums); "
                    "errors_up, errors_down (of pow, exp, log, inversesqrt); all; repeatable")
        ->type_name("NAME")
        ->allow_extra_args(false)
        ->check(CLI::IsMember(machine_names()))
        ->default_str("ieee and flushed");
    app->add_option(
           "--inputs", options->inputs,
           "A file whose [domain] says what inputs and uniforms hold, beside the family's or instead")
        ->type_name("FILE");
    app->add_flag("--rounding", options->rounding,
                  "Instead, the largest difference between fp32 and fp64 of every output, and what makes it");
    app->add_flag("--json", options->json, "With --rounding: as JSON, with every contribution");
    app->add_option("-o,--output", options->folder,
                    "Folder for the inputs of what is found, as input files of gobo eval")
        ->type_name("FOLDER")
        ->capture_default_str();
    add_common_options(*app, options->common);
    app->footer(
        "Inputs lie within the family's domains; of files, and where no domain is declared, within [-100, "
        "100].\n"
        "Each is run on all the machines.\n\n"
        "Examples:\n"
        "  gobo sanitize lit                           the family's default set\n"
        "  gobo sanitize lit --cover 3 --total 10000000\n"
        "  gobo sanitize lit --machine all\n"
        "  gobo sanitize lit --machine errors_up --machine errors_down --minutes 10\n"
        "  gobo sanitize lit --rounding                where each output loses most precision\n"
        "  gobo sanitize game.vert game.frag --inputs ranges.toml");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
