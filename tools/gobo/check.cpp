// gobo check: composes and validates a selection; says nothing when all is well.
#include "gobo/commands.hpp"

namespace gobo {
namespace {

struct CheckOptions : SelectionOptions {
    bool spirv_val = false;
};

Result<Outcome> run(const CheckOptions& options, const World& world) {
    GOBO_TRY(LoadedFamily family, load_family(world, options.family, options.dialect));
    GOBO_TRY(Composition composition, compose_selection(world, family, options));
    GOBO_TRY(Validated validated, compile(world, family, composition, {.spirv_val = options.spirv_val}));
    append(validated.diagnostics, composition.warnings);
    append(validated.diagnostics, same_programs(family.family, composition, validated));
    append(validated.diagnostics, warn_of_no_keys(composition, "nothing was checked"));
    return Outcome{{}, std::move(validated.diagnostics)};
}

}  // namespace

Command check_command() {
    const auto options = std::make_shared<CheckOptions>();
    return {{"check", "Compose and validate a selection; prints nothing when all is well"},
            {family_argument(options->family),
             {"--spirv-val", "", "Ask SPIRV-Tools' validator as well", &options->spirv_val},
             dialect_option(options->dialect)},
            {selection_options(*options)},
            "  gobo check lit                              the family's default set\n"
            "  gobo check lit --cover 3 --spirv-val\n"
            "  gobo check lit --all --where 'point <= 1 && spot <= 1 && directional <= 1' --dialect es300\n"
            "  gobo check game.toml -I my_pieces",
            [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
