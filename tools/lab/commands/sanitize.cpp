// gobo sanitize: runs every stage of a selection, or loose GLSL files, on hard inputs, with each operation
// watched.
#include "lab/sanitize/sanitize.hpp"

#include <fmt/format.h>

#include "lab/commands/finding_report.hpp"
#include "lab/sanitize/precision.hpp"

namespace gobo {
namespace {

struct SanitizeCommandOptions : FindingOptions {
    sanitize::SanitizeOptions sanitize;
    bool rounding = false;
    bool json = false;
    std::vector<std::string> machines = {"ieee", "flushed"};
};

/// How many inputs of how many keys show it.
std::string counted(const sanitize::SharedFinding& shared, bool has_keys) {
    const std::string shown_by =
        shared.finding.is_of_constants ? "of constants" : fmt::format("{} points", shared.finding.points);
    const std::string keys = has_keys ? fmt::format(", {} keys", shared.permutations.size()) : "";
    return fmt::format("{} ({}{})", to_text(shared.finding), shown_by, keys);
}

/// Years of work, yet what is counted from it fits into 64 bits.
constexpr double kMostPoints = 1e12;

/// "ieee|flushed|...|all".
std::string machine_words() {
    std::string words;
    for (const sanitize::Machine machine : sanitize::kMachines) words += fmt::format("{}|", name_of(machine));
    return words + "all";
}

/// The names have been checked when the command line was read.
std::vector<sanitize::Machine> machines_of(const std::vector<std::string>& names) {
    std::vector<sanitize::Machine> machines;
    for (const std::string& name : names)
        if (name == "all")
            machines.assign(std::begin(sanitize::kMachines), std::end(sanitize::kMachines));
        else if (const auto machine = sanitize::machine_named(name))
            machines.push_back(*machine);
    return machines;
}

Result<Outcome> run(const SanitizeCommandOptions& options, const World& world) {
    GOBO_TRY(const Examined examined, load_examined(world, options, "gobo sanitize evaluates"));
    const auto& [subject, validated] = examined;
    const Family& family = subject.family.family;
    sanitize::SanitizeOptions wanted = options.sanitize;
    wanted.jobs = world.jobs();
    wanted.cache = world.cache;
    wanted.machines = machines_of(options.machines);
    if (options.rounding) {
        GOBO_TRY(const auto stages,
                 sanitize::measure_precision(family, subject.composition, validated, wanted));
        return Outcome{options.json ? sanitize::precision_json(stages) : sanitize::precision_text(stages),
                       validated.diagnostics};
    }
    const auto found = sanitize::sanitize(family, subject.composition, validated, wanted);
    Diagnostics diagnostics = validated.diagnostics;
    append(diagnostics, found.diagnostics);
    leave_out_keys(subject, diagnostics);
    for (std::size_t i = 0; i < found.findings.size(); ++i) {
        const sanitize::SharedFinding& shared = found.findings[i];
        append(diagnostics, report_finding(world, options, subject, shared.finding, shared.permutations,
                                           counted(shared, !subject.are_files), i + 1));
    }
    return Outcome{fmt::format("{} permutations, {} stages, {} points on {} machines, {} findings\n",
                               subject.composition.permutations.size(), found.stages, found.points,
                               wanted.machines.size(), found.findings.size()),
                   std::move(diagnostics)};
}

}  // namespace

Command sanitize_command() {
    const auto options = std::make_shared<SanitizeCommandOptions>();
    sanitize::SanitizeOptions& wanted = options->sanitize;
    return {
        titles::kSanitize,
        {family_or_files_argument(options->names),
         stages_option(options->stages),
         keep_option(options->folder, "inputs that show what is found, for gobo eval,"),
         {"--points", "N", "How many extreme inputs each distinct stage gets", &wanted.points,
          between(1, kMostPoints)},
         {"--total", "N", "Instead, at least so many over all stages", &wanted.total,
          between(1, kMostPoints)},
         {"--seed", "N", "Another seed tries other inputs", &wanted.seed, between(0, 1e15)},
         {"--guided", "N",
          "Then so many inputs derived from those that reached a new branch or came nearest to a trap",
          &wanted.guided, between(0, kMostPoints)},
         {"--minutes", "N", "Go on with such inputs for so long", &wanted.minutes, between(0, 60 * 24 * 365)},
         {"--machine", machine_words(),
          "What arithmetic to evaluate with, of those that GLSL allows: ieee; flushed (denormals are 0); "
          "nan_kept, "
          "nan_dropped (by min, max, clamp); fused (a * b + c); regrouped, reordered (sums); "
          "errors_up, errors_down (of division, sqrt, normalize, pow, exp, log, sin and their like); "
          "mediump (16-bit floats where the shader allows them), mediump_flushed (denormal ones are 0); all",
          &options->machines, kOneOf},
         domains_option(*options),
         dialect_option(options->dialect),
         {"--rounding", "",
          "Instead, the largest difference between fp32 and fp64 of every output, and what makes it",
          &options->rounding},
         {"--json", "", "With --rounding: as JSON, with every contribution", &options->json}},
        {selection_options(*options)},
        "  gobo sanitize lit                           the family's default set\n"
        "  gobo sanitize lit --cover 3 --total 10000000\n"
        "  gobo sanitize lit --machine all\n"
        "  gobo sanitize lit --machine errors_up --machine errors_down --minutes 10\n"
        "  gobo sanitize lit --rounding                where each output loses most precision\n"
        "  gobo sanitize game.vert game.frag --inputs ranges.toml -o found",
        [options](const World& world) { return run(*options, world); },
        "Inputs lie within the family's domains; of files, and where no domain is declared, within [-100, "
        "100]. Each is run with every arithmetic that --machine names."};
}

}  // namespace gobo
