// gobo build: the generated header, its manifest and its depfile.
#include <set>
#include <utility>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "emit/emit.hpp"
#include "gobo/budget.hpp"
#include "gobo/commands.hpp"
#include "reflect/interface.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

struct BuildOptions {
    CommonOptions common;
    SelectionOptions selection;
    BudgetOptions budget;
    std::string family;
    std::string dialect;
    std::string folder;
    std::string cpp_namespace;
    std::string depfile_target;
    bool comments = false;
};

/// The interface of the whole family: what any permutation of the composition declares.
Result<Interface> united_interface(const Composition& composition, const Validated& validated) {
    std::vector<Interface> programs;
    std::set<std::pair<int, int>> seen;
    for (const Permutation& permutation : composition.permutations) {
        if (!seen.emplace(permutation.vertex, permutation.fragment).second) continue;
        programs.push_back(interface_of(validated, permutation));
    }
    return unite(programs);
}

Result<HeaderTemplates> header_templates(const World& world, const CommonOptions& options) {
    if (options.library.empty()) return read_header_templates(world.shipped, "templates/header");
    return read_header_templates(world.disk, options.library + "/templates/header");
}

/// The files that the outputs were made from, each once.
std::vector<std::string> files_read(const LoadedFamily& family, const Composition& composition,
                                    const CommonOptions& options, const HeaderTemplates& templates) {
    std::set<std::string> files(family.files.begin(), family.files.end());
    files.insert(composition.files.begin(), composition.files.end());
    if (!options.library.empty()) files.insert({templates.header.name, templates.structure.name});
    return {files.begin(), files.end()};
}

/// Writes all three, the depfile last: a build tool that is interrupted before then runs the command again.
Result<int> write_all(const World& world, const std::vector<std::pair<std::string, std::string>>& outputs) {
    int changed = 0;
    for (const auto& [path, text] : outputs) {
        const Result<bool> written = world.disk.write(path, text);
        if (!written) return tl::unexpected(written.error());
        changed += *written ? 1 : 0;
    }
    return changed;
}

Result<std::vector<std::pair<std::string, std::string>>> emit_all(
    const BuildOptions& options, const World& world, const LoadedFamily& family,
    const Composition& composition, const Validated& validated, std::vector<QualityChoice> qualities) {
    const Result<Interface> interface = united_interface(composition, validated);
    if (!interface) return tl::unexpected(interface.error());
    const Result<HeaderTemplates> templates = header_templates(world, options.common);
    if (!templates) return tl::unexpected(templates.error());
    const EmitInput input{family.family, composition, *interface, options.cpp_namespace,
                          std::move(qualities)};
    Result<std::string> header = emit_header(input, *templates);
    if (!header) return tl::unexpected(header.error());
    const std::string stem = options.folder + "/" + family.family.name;
    const std::string target = options.depfile_target.empty() ? stem + ".hpp" : options.depfile_target;
    const std::vector<std::string> read = files_read(family, composition, options.common, *templates);
    return std::vector<std::pair<std::string, std::string>>{{stem + ".hpp", std::move(*header)},
                                                            {stem + ".json", emit_manifest(input)},
                                                            {stem + ".d", emit_depfile({target}, read)}};
}

/// The keys of the selection, or those that the budget chooses for their effects.
struct Chosen {
    std::vector<Key> keys;
    std::vector<QualityChoice> qualities;
};

Result<Chosen> choose_keys(const BuildOptions& options, const World& world, LoadedFamily& family,
                           Dialect dialect) {
    Result<std::vector<Key>> keys = load_keys(world, family, options.selection, dialect);
    if (!keys) return tl::unexpected(keys.error());
    if (!options.budget.is_set()) return Chosen{std::move(*keys), {}};
    auto qualities =
        choose_qualities(world, family, options.budget, *keys, name_of(dialect), options.common.jobs);
    if (!qualities) return tl::unexpected(qualities.error());
    std::set<Key> distinct;
    for (const QualityChoice& choice : *qualities) distinct.insert(choice.key);
    return Chosen{{distinct.begin(), distinct.end()}, std::move(*qualities)};
}

Outcome run(const BuildOptions& options, const World& world) {
    const Result<Dialect> dialect = read_dialect(options.dialect);
    if (!dialect) return failed(dialect.error());
    Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const Result<Chosen> chosen = choose_keys(options, world, *family, *dialect);
    if (!chosen) return failed(chosen.error());
    const Result<Composition> composition = compose(family->family, chosen->keys, family->search, *dialect,
                                                    options.comments ? Comments::keep : Comments::remove);
    if (!composition) return failed(composition.error());
    ValidateOptions validate_options;
    validate_options.jobs = options.common.jobs;
    Validated validated = validate(family->family, *composition, validate_options);
    if (exit_status(validated.diagnostics) != 0) return failed(std::move(validated.diagnostics));
    const auto outputs = emit_all(options, world, *family, *composition, validated, chosen->qualities);
    if (!outputs) return failed(outputs.error());
    const Result<int> changed = write_all(world, *outputs);
    if (!changed) return failed(changed.error());
    std::string summary = fmt::format("{}: {} permutations, {} stages, {} pieces{}", outputs->front().first,
                                      composition->permutations.size(), composition->stages.size(),
                                      composition->pieces.size(), *changed == 0 ? " (unchanged)" : "");
    return {{}, std::move(validated.diagnostics), std::move(summary)};
}

}  // namespace

Command build_command(CLI::App& gobo) {
    auto options = std::make_shared<BuildOptions>();
    CLI::App* app = gobo.add_subcommand("build", "Write the C++ header, the JSON manifest and the depfile");
    app->add_option("FAMILY", options->family, "A shipped family or a .toml file")->required();
    app->add_option("-o,--output", options->folder, "Folder for FAMILY.hpp, FAMILY.json and FAMILY.d")
        ->required()
        ->type_name("DIR");
    app->add_option("--namespace", options->cpp_namespace,
                    "C++ namespace of the header; by default the family's name")
        ->type_name("NAME");
    app->add_option("--depfile-target", options->depfile_target,
                    "What the depfile says is made, by default the header: a stamp, for build tools that "
                    "compare times")
        ->type_name("FILE");
    add_comments_option(*app, options->comments);
    add_selection_options(*app, options->selection);
    add_budget_options(*app, options->budget);
    add_dialect_option(*app, options->dialect);
    add_common_options(*app, options->common);
    app->footer(
        "Examples:\n"
        "  gobo build lit --key 'fog=linear point=3' --key default -o generated\n"
        "  gobo build lit --cover 3 --where 'point <= 2' -o out\n"
        "  gobo build lit --keys-from recorded.txt --namespace game::shaders --dialect 330 -o generated\n"
        "  gobo build lit --key 'directional=1 specular=blinn' --max-error 0.01 -o generated\n"
        "  gobo build game.toml --all -I my_pieces -o generated");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
