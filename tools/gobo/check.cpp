// gobo check: composes and validates a selection; says nothing when all is well.
#include <fmt/format.h>

#include "compose/compose.hpp"
#include "gobo/commands.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct CheckOptions {
    CommonOptions common;
    SelectionOptions selection;
    std::string family;
    std::string dialect;
    bool spirv_val = false;
};

/// Silence would be taken for success.
Diagnostic nothing_to_check() {
    Diagnostic diagnostic;
    diagnostic.severity = Severity::warning;
    diagnostic.message = "the selection holds no keys, so nothing was checked";
    diagnostic.help = "see what a selection holds with 'gobo list'";
    return diagnostic;
}

Outcome run(const CheckOptions& options, const World& world) {
    const Result<Dialect> dialect = read_dialect(options.dialect);
    if (!dialect) return failed(dialect.error());
    Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const Result<Composition> composition = load_composition(world, *family, options.selection, *dialect);
    if (!composition) return failed(composition.error());
    if (composition->permutations.empty()) return failed({nothing_to_check()});
    ValidateOptions validate_options;
    validate_options.jobs = options.common.jobs;
    validate_options.spirv_val = options.spirv_val;
    Diagnostics found = validate(family->family, *composition, validate_options).diagnostics;
    if (exit_status(found) == 0) {  // beside errors it would only distract
        const Diagnostics alike = same_stages(family->family, *composition);
        found.insert(found.end(), alike.begin(), alike.end());
    }
    return {{}, std::move(found), {}};
}

}  // namespace

Command check_command(CLI::App& gobo) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* app =
        gobo.add_subcommand("check", "Compose and validate a selection; prints nothing when all is well");
    app->add_option("FAMILY", options->family, "A shipped family or a .toml file")->required();
    add_selection_options(*app, options->selection);
    add_dialect_option(*app, options->dialect);
    app->add_flag("--spirv-val", options->spirv_val, "Ask SPIRV-Tools' validator as well");
    add_common_options(*app, options->common);
    app->footer(
        "Examples:\n"
        "  gobo check lit                              the family's default set\n"
        "  gobo check lit --cover 3 --spirv-val\n"
        "  gobo check lit --all --where 'point <= 1 && spot <= 1 && directional <= 1' --dialect es300\n"
        "  gobo check game.toml -I my_pieces");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
