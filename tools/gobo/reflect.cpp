// gobo reflect: the interface of a permutation, or of loose GLSL files.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compose/compose.hpp"
#include "compose/loose_files.hpp"
#include "gobo/commands.hpp"
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

/// The family with its one permutation, whichever way it was named.
struct Subject {
    Family family;
    Composition composition;
};

Result<Subject> subject_of_files(const ReflectOptions& options, const World& world) {
    SearchPath search;
    for (const std::string& folder : options.common.include_folders) search.add(world.disk, folder, "", true);
    Result<Family> family = family_of_files(options.names, world.disk, search);
    if (!family) return tl::unexpected(family.error());
    const Result<Dialect> dialect = read_dialect(options.dialect);
    if (!dialect) return tl::unexpected(dialect.error());
    Result<Composition> composition = compose(*family, {Key{}}, search, *dialect);
    if (!composition) return tl::unexpected(composition.error());
    return Subject{std::move(*family), std::move(*composition)};
}

Result<Subject> subject_of_key(const ReflectOptions& options, const World& world) {
    if (options.names.size() > 2) {
        return fail(Fault::usage, fmt::format("'{}' is one name too many", options.names[2]),
                    "name a family and a key, or shader files; quote a key that has blanks");
    }
    const Result<Dialect> dialect = read_dialect(options.dialect);
    if (!dialect) return tl::unexpected(dialect.error());
    Result<LoadedFamily> family = load_family(world, options.names[0], options.common);
    if (!family) return tl::unexpected(family.error());
    SelectionOptions selection;
    selection.keys = {options.names.size() > 1 ? options.names[1] : "default"};
    Result<Composition> composition = load_composition(world, *family, selection, *dialect);
    if (!composition) return tl::unexpected(composition.error());
    return Subject{std::move(family->family), std::move(*composition)};
}

Outcome run(const ReflectOptions& options, const World& world) {
    const bool are_files = std::any_of(options.names.begin(), options.names.end(), is_shader_file);
    const Result<Subject> subject =
        are_files ? subject_of_files(options, world) : subject_of_key(options, world);
    if (!subject) return failed(subject.error());
    Validated validated = validate(subject->family, subject->composition, {});
    if (are_files) {
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
