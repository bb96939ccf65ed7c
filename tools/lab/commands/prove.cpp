// gobo prove: which traps of the sanitizer no input of the domain can reach.
#include "lab/prove/prove.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/commands/lab_input.hpp"
#include "lab/sanitize/sanitize.hpp"

namespace gobo {
namespace {

struct ProveCommandOptions : SelectionOptions {
    prove::ProveOptions prove;
    std::vector<std::string> names;  ///< FAMILY, or files
    std::vector<std::string> stages;
    std::string folder;  ///< for inputs that show what is possible; empty: they are not kept
    std::string inputs;  ///< a file of domains
    bool json = false;
};

/// What is possible as an error, its example as an input file where -o says.
Diagnostics report(const World& world, const ProveCommandOptions& options, const Subject& subject,
                   const prove::SourceOperation& operation, const prove::ProvenRule& rule,
                   std::size_t number) {
    Diagnostics diagnostics(1);
    Diagnostic& error = diagnostics.front();
    error.place = operation.place;
    error.quoted_line = quoted_line(subject.composition, operation.place);
    error.message = to_text(rule.example);
    std::vector<std::string> names = options.names;
    std::ranges::transform(names, names.begin(), shell_word);
    std::string what = join(names, " ");
    const auto permutations = sanitize::permutations_of(subject.composition, rule.stage);
    if (!subject.are_files && !permutations.empty()) {
        error.subject =
            key_text(subject.family.family, subject.composition.permutations[permutations.front()].key);
        what += fmt::format(" '{}'", error.subject);
    }
    if (options.folder.empty()) {
        error.help =
            "guard the operation; keep an input that shows it with -o DIR, and follow it with gobo eval "
            "--trace";
        return diagnostics;
    }
    const std::string name = operation.place.file.substr(operation.place.file.rfind('/') + 1);
    const std::string path =
        fmt::format("{}/{}.{}.{}.toml", options.folder, number, name, operation.place.line);
    const std::string follow = fmt::format("gobo eval {} --inputs {} --trace", what, shell_word(path));
    error.help = "guard the operation; follow the input with: " + follow;
    append(diagnostics, keep_file(world, path, sanitize::eval_input(rule.example, follow)));
    return diagnostics;
}

Result<Outcome> run(const ProveCommandOptions& options, const World& world) {
    GOBO_TRY(Subject subject, load_subject(world, options.names, options.stages, "", &options));
    GOBO_TRY_DO(refuse_other_stages(subject.family.family, subject.composition, "gobo prove evaluates"));
    GOBO_TRY(const Validated validated, compile_over_domains(world, subject, options.inputs));
    const Family& family = subject.family.family;
    prove::ProveOptions wanted = options.prove;
    wanted.jobs = world.jobs();
    wanted.cache = world.cache;
    const prove::ProveReport found = prove::prove(family, subject.composition, validated, wanted);
    Diagnostics diagnostics = validated.diagnostics;
    append(diagnostics, found.diagnostics);
    std::size_t number = 0;
    for (const prove::SourceOperation& operation : found.operations)
        for (const prove::ProvenRule& rule : operation.rules)
            if (rule.status == prove::Status::possible)
                append(diagnostics, report(world, options, subject, operation, rule, ++number));
    return Outcome{options.json ? prove::proof_json(found) : prove::proof_text(found),
                   std::move(diagnostics)};
}

}  // namespace

Command prove_command() {
    const auto options = std::make_shared<ProveCommandOptions>();
    prove::ProveOptions& wanted = options->prove;
    return {titles::kProve,
            {{"NAMES", "FAMILY|FILES...", "A family, or shader files (.vert, .frag, .vert.glsl, .frag.glsl)",
              &options->names, kRequired},
             stages_option(options->stages),
             keep_option(options->folder, "inputs that show what is possible, for gobo eval,"),
             {"--splits", "N", "Into how many parts the domain is split for one rule at one place, at most",
              &wanted.splits, between(0, 1e9)},
             {"--points", "N",
              "How many inputs a stage gets in search of an example where something is undecided",
              &wanted.points, between(0, 1e12)},
             {"--check", "N",
              "Evaluate so many hard inputs over all stages, on each variant of arithmetic in turn, and hold "
              "the proofs to them",
              &wanted.check, between(0, 1e12)},
             {"--seed", "N", "Another seed tries other inputs", &wanted.seed, between(0, 1e15)},
             {"--inputs", "FILE",
              "A file whose [domain] says what inputs and uniforms hold, beside the family's or instead",
              &options->inputs},
             {"--json", "", "As JSON, with every operation", &options->json}},
            {selection_options(*options)},
            "  gobo prove lit                              the family's default set\n"
            "  gobo prove lit --key 'spot=1 fog=linear'\n"
            "  gobo prove lit --cover 2 --json\n"
            "  gobo prove game.vert game.frag --inputs ranges.toml -o found",
            [options](const World& world) { return run(*options, world); },
            "Inputs lie within the family's domains; of files, and where no domain is declared, within "
            "[-100, 100]. What is "
            "impossible is so with every arithmetic that gobo sanitize knows."};
}

}  // namespace gobo
