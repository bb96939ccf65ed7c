// gobo list: the keys of a selection.
#include <nlohmann/json.hpp>

#include "compose/dialect.hpp"
#include "family/key.hpp"
#include "gobo/commands.hpp"

namespace gobo {
namespace {

struct ListOptions {
    CommonOptions common;
    SelectionOptions selection;
    std::string family;
    std::string dialect;
    bool count = false;
    bool json = false;
};

/// {"family", "keys": [{"key", "features": {name: value}}]}, every feature named.
std::string keys_as_json(const Family& family, const std::vector<Key>& keys) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Key& key : keys) {
        nlohmann::ordered_json features;
        for (std::size_t i = 0; i < key.size(); ++i) {
            const Feature& feature = family.features[i];
            if (feature.kind == FeatureKind::count) {
                features[feature.name] = key[i];
            } else {
                features[feature.name] = feature.values[static_cast<std::size_t>(key[i])];
            }
        }
        rows.push_back({{"key", key_text(family, key)}, {"features", std::move(features)}});
    }
    return nlohmann::ordered_json{{"family", family.name}, {"keys", std::move(rows)}}.dump(2) + "\n";
}

Outcome run(const ListOptions& options, const World& world) {
    const Result<Dialect> dialect = read_dialect(options.dialect);
    if (!dialect) return failed(dialect.error());
    Result<LoadedFamily> family = load_family(world, options.family, options.common);
    if (!family) return failed(family.error());
    const bool names_files = !options.selection.key_files.empty() || !options.selection.scenes.empty();
    if (options.count && !names_files) {  // by arithmetic, where no key need be made
        const Result<std::uint64_t> count =
            count_selected(family->family, to_selection(options.selection), name_of(*dialect));
        if (!count) return failed(count.error());
        return {std::to_string(*count) + "\n", {}, {}};
    }
    const Result<std::vector<Key>> keys = load_keys(world, *family, options.selection, *dialect);
    if (!keys) return failed(keys.error());
    if (options.count) return {std::to_string(keys->size()) + "\n", {}, {}};
    if (options.json) return {keys_as_json(family->family, *keys), {}, {}};
    Outcome outcome;
    for (const Key& key : *keys) outcome.output += key_text(family->family, key) + "\n";
    return outcome;
}

}  // namespace

Command list_command(CLI::App& gobo) {
    auto options = std::make_shared<ListOptions>();
    CLI::App* app = gobo.add_subcommand("list", "The keys of a selection, one a line");
    app->add_option("FAMILY", options->family, "A shipped family or a .toml file")->required();
    add_selection_options(*app, options->selection);
    add_dialect_option(*app, options->dialect);
    app->add_flag("--count", options->count, "Print only how many there are");
    app->add_flag("--json", options->json, "Print JSON with every feature's value");
    add_common_options(*app, options->common);
    app->footer(
        "Examples:\n"
        "  gobo list lit                                  the family's default set\n"
        "  gobo list lit --all --where 'point <= 2' --count\n"
        "  gobo list lit --cover 3 --over fog,fog_distance,shading\n"
        "  gobo list lit --key 'point=3 fog=linear'       the canonical form of a key");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
