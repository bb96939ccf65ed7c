// gobo show: the composed source of one key.
#include <fmt/format.h>

#include "core/text.hpp"
#include "gobo/commands.hpp"

namespace gobo {
namespace {

struct ShowOptions {
    CommonOptions common;
    std::string family;
    std::string key;
    std::string stage;
    std::string dialect;
    bool pieces = false;
    bool comments = false;
};

std::string shown(const Composition& composition, const Stage& stage, const ShowOptions& options) {
    if (!options.pieces) return source_of(composition, stage);
    std::string text;
    for (const int piece : stage.pieces)
        text += composition.pieces[static_cast<std::size_t>(piece)].name + "\n";
    return text;
}

Outcome run(const ShowOptions& options, const World& world) {
    const Result<Dialect> dialect = read_dialect(options.dialect);
    if (!dialect) return failed(dialect.error());
    Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    SelectionOptions selection;
    selection.keys = {options.key};
    const Result<Composition> composition = load_composition(
        world, *family, selection, *dialect, options.comments ? Comments::keep : Comments::remove);
    if (!composition) return failed(composition.error());
    const Permutation& permutation = composition->permutations.front();
    const Stage& vertex = composition->stages[static_cast<std::size_t>(permutation.vertex)];
    const Stage& fragment = composition->stages[static_cast<std::size_t>(permutation.fragment)];
    if (options.stage.starts_with("vert")) return {shown(*composition, vertex, options), {}, {}};
    if (options.stage.starts_with("frag")) return {shown(*composition, fragment, options), {}, {}};
    const std::string_view comment = options.pieces ? "" : "// ";
    return {fmt::format("{0}vertex:\n{1}\n{0}fragment:\n{2}", comment, shown(*composition, vertex, options),
                        shown(*composition, fragment, options)),
            {},
            {}};
}

}  // namespace

Command show_command(CLI::App& gobo) {
    auto options = std::make_shared<ShowOptions>();
    CLI::App* app = gobo.add_subcommand("show", "The composed source of a key");
    app->add_option("FAMILY", options->family, "A shipped family or a .toml file")->required();
    app->add_option("KEY", options->key, "A key, such as 'fog=linear point=3'")->required();
    app->add_option("--stage", options->stage, "Only this stage")
        ->type_name("vertex|fragment")
        ->check(CLI::IsMember({"vertex", "fragment", "vert", "frag"}));
    app->add_flag("--pieces", options->pieces, "Print the pieces' names instead of their text");
    add_comments_option(*app, options->comments);
    add_dialect_option(*app, options->dialect);
    add_common_options(*app, options->common);
    app->footer(
        "Examples:\n"
        "  gobo show lit default\n"
        "  gobo show lit 'fog=linear point=3' --stage fragment | glslangValidator --stdin -S frag -G\n"
        "  gobo show lit 'fog=linear point=3' --pieces\n"
        "  gobo show lit 'spot=1' --stage vertex --dialect es300");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
