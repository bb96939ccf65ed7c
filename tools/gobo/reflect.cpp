// gobo reflect: the interface of a permutation, or of loose GLSL files.
#include <nlohmann/json.hpp>

#include "gobo/commands.hpp"
#include "gobo/subject.hpp"
#include "reflect/interface_format.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct ReflectOptions {
    CommonOptions common;
    std::vector<std::string> names;  ///< FAMILY KEY, or files
    std::string dialect;
    bool json = false;
};

Outcome run(const ReflectOptions& options, const World& world) {
    const Result<Subject> subject = load_subject(world, options.names, options.common, options.dialect);
    if (!subject) return failed(subject.error());
    Validated validated = validate(subject->family, subject->composition, {});
    if (subject->are_files) {
        for (Diagnostic& diagnostic : validated.diagnostics) diagnostic.subject.clear();
    }
    if (exit_status(validated.diagnostics) != 0) return failed(std::move(validated.diagnostics));
    const Interface interface = interface_of(validated, subject->composition.permutations.front());
    std::string text = options.json ? to_json(interface).dump(2) + "\n" : to_text(interface);
    return {std::move(text), std::move(validated.diagnostics), {}};
}

}  // namespace

Command reflect_command(CLI::App& gobo) {
    auto options = std::make_shared<ReflectOptions>();
    CLI::App* app = gobo.add_subcommand("reflect", "The interface of a permutation, or of GLSL files");
    app->add_option("NAMES", options->names,
                    "FAMILY KEY, or shader files (.vert, .frag, .vert.glsl, .frag.glsl)")
        ->required()
        ->type_name("FAMILY KEY|FILES...");
    app->add_flag("--json", options->json, "Print JSON");
    add_dialect_option(*app, options->dialect);
    add_common_options(*app, options->common);
    app->footer(
        "Examples:\n"
        "  gobo reflect lit 'fog=linear point=3'\n"
        "  gobo reflect lit 'fog=linear point=3' --json\n"
        "  gobo reflect game.vert game.frag --json");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
