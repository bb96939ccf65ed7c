// gobo check: composes and validates a selection, or loose GLSL files; says nothing when all is well.
#include "gobo/commands.hpp"

namespace gobo {
namespace {

struct CheckOptions : SelectionOptions {
    std::vector<std::string> names;  ///< FAMILY, or files
    std::vector<std::string> stages;
    bool spirv_val = false;
};

Result<Outcome> run(const CheckOptions& options, const World& world) {
    GOBO_TRY(Subject subject, load_subject(world, options.names, options.stages, options.dialect, &options));
    GOBO_TRY(Validated validated, compile(world, subject, {.spirv_val = options.spirv_val}));
    append(validated.diagnostics, subject.composition.warnings);
    append(validated.diagnostics, same_programs(subject.family.family, subject.composition, validated));
    append(validated.diagnostics, warn_of_no_keys(subject.composition, "nothing was checked"));
    return Outcome{{}, std::move(validated.diagnostics)};
}

}  // namespace

Command check_command() {
    const auto options = std::make_shared<CheckOptions>();
    return {{"check", "Validate a selection, or GLSL files; prints nothing when all is well"},
            {family_or_files_argument(options->names),
             stages_option(options->stages),
             {"--spirv-val", "", "Ask SPIRV-Tools' validator as well", &options->spirv_val},
             dialect_option(options->dialect)},
            {selection_options(*options)},
            "  gobo check lit                              the family's default set\n"
            "  gobo check lit --cover 3 --spirv-val\n"
            "  gobo check lit --all --where 'point <= 1 && spot <= 1 && directional <= 1' --dialect es300\n"
            "  gobo check game.toml -I my_pieces\n"
            "  gobo check game.vert game.frag",
            [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
