// gobo list: the keys of a selection.
#include <nlohmann/json.hpp>

#include "compose/dialect.hpp"
#include "family/key.hpp"
#include "gobo/commands.hpp"

namespace gobo {
namespace {

struct ListOptions : SelectionOptions {
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
            if (feature.kind == FeatureKind::count)
                features[feature.name] = feature.lowest + key[i];
            else
                features[feature.name] = feature.values[key[i]];
        }
        rows.push_back({{"key", key_text(family, key)}, {"features", std::move(features)}});
    }
    return nlohmann::ordered_json{{"family", family.name}, {"keys", std::move(rows)}}.dump(2) + "\n";
}

Result<Outcome> run(const ListOptions& options, const World& world) {
    GOBO_TRY(LoadedFamily loaded, load_family(world, options.family, options.dialect));
    const Family& family = loaded.family;
    GOBO_TRY(const Selection selection, load_selection(world, loaded, options));
    if (options.count) {
        GOBO_TRY(const auto count, count_selected(family, selection, name_of(loaded.dialect)));
        return Outcome{count.text() + "\n"};
    }
    GOBO_TRY(const auto keys, select(family, selection, name_of(loaded.dialect)));
    if (options.json) return Outcome{keys_as_json(family, keys)};
    Outcome outcome;
    for (const Key& key : keys) outcome.output += key_text(family, key) + "\n";
    return outcome;
}

}  // namespace

Command list_command() {
    const auto options = std::make_shared<ListOptions>();
    return {{"list", "The keys of a selection, one a line"},
            {family_argument(options->family),
             {"--count", "", "Print only how many there are", &options->count},
             {"--json", "", "Print JSON with every feature's value", &options->json},
             dialect_option(options->dialect)},
            {selection_options(*options)},
            "  gobo list lit                                  the family's default set\n"
            "  gobo list lit --all --where 'point <= 2' --count\n"
            "  gobo list lit --cover 3 --over fog,fog_distance,shading\n"
            "  gobo list lit --key 'point=3 fog=linear'       the canonical form of a key",
            [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
