// gobo prove: which traps of the sanitizer no input of the domain can reach.
#include "lab/prove/prove.hpp"

#include "lab/commands/finding_report.hpp"
#include "lab/sanitize/sanitize.hpp"

namespace gobo {
namespace {

struct ProveCommandOptions : FindingOptions {
    prove::ProveOptions prove;
    bool json = false;
};

Result<Outcome> run(const ProveCommandOptions& options, const World& world) {
    GOBO_TRY(const Examined examined, load_examined(world, options, "gobo prove evaluates"));
    const auto& [subject, validated] = examined;
    const Family& family = subject.family.family;
    prove::ProveOptions wanted = options.prove;
    wanted.jobs = world.jobs();
    wanted.cache = world.cache;
    const prove::ProveReport found = prove::prove(family, subject.composition, validated, wanted);
    Diagnostics diagnostics = validated.diagnostics;
    append(diagnostics, found.diagnostics);
    leave_out_keys(subject, diagnostics);
    std::size_t number = 0;
    for (const prove::SourceOperation& operation : found.operations)
        for (const prove::ProvenRule& rule : operation.rules)
            if (rule.status == prove::Status::possible)
                append(diagnostics, report_finding(world, options, subject, rule.example,
                                                   sanitize::permutations_of(subject.composition, rule.stage),
                                                   to_text(rule.example), ++number));
    return Outcome{options.json ? prove::proof_json(found) : prove::proof_text(found),
                   std::move(diagnostics)};
}

}  // namespace

Command prove_command() {
    const auto options = std::make_shared<ProveCommandOptions>();
    prove::ProveOptions& wanted = options->prove;
    return {titles::kProve,
            {family_or_files_argument(options->names),
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
             domains_option(*options),
             dialect_option(options->dialect),
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
