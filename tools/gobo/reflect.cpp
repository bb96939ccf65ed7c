// gobo reflect: the interface of a permutation, or of loose GLSL files.
#include <nlohmann/json.hpp>

#include "gobo/commands.hpp"
#include "reflect/interface_format.hpp"

namespace gobo {
namespace {

struct ReflectOptions {
    std::vector<std::string> names;  ///< FAMILY KEY, or files
    std::vector<std::string> stages;
    std::string dialect;
    bool json = false;
};

Result<Outcome> run(const ReflectOptions& options, const World& world) {
    GOBO_TRY(Subject subject, load_subject(world, options.names, options.stages, options.dialect));
    GOBO_TRY(Validated validated, compile(world, subject));
    const Interface interface = interface_of(validated, subject.composition.permutations.front());
    return Outcome{options.json ? to_json(interface).dump(2) + "\n" : to_text(interface),
                   std::move(validated.diagnostics)};
}

}  // namespace

Command reflect_command() {
    const auto options = std::make_shared<ReflectOptions>();
    return {{"reflect", "The interface of a permutation, or of GLSL files"},
            {subject_argument(options->names),
             stages_option(options->stages),
             {"--json", "", "Print JSON", &options->json},
             dialect_option(options->dialect)},
            {},
            "  gobo reflect lit 'fog=linear point=3'\n"
            "  gobo reflect lit 'fog=linear point=3' --json\n"
            "  gobo reflect game.vert game.frag --json",
            [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
