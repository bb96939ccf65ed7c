// gobo list: the keys of a selection.
#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compose/dialect.hpp"
#include "family/key.hpp"
#include "gobo/commands.hpp"

namespace gobo {
namespace {

struct ListOptions : SelectionOptions {
    bool count = false;
    bool json = false;
    std::string against;
    bool warm_up = false;
};

/// The keys that were asked for, and those that were built.
struct Compared {
    std::vector<Key> missing;     ///< asked for, not built
    std::vector<Key> never_used;  ///< built, not asked for
    std::vector<Key> warm_up;     ///< both
};

/// The value of a feature: a number for a count, a word for any other.
nlohmann::ordered_json value_of(const Family& family, const Key& key, std::size_t index) {
    const Feature& feature = family.features[index];
    if (feature.kind == FeatureKind::count) return feature.lowest + key[index];
    return feature.values[static_cast<std::size_t>(key[index])];
}

/// {"family", "keys": [{"key", "features": {name: value}}]}, every feature named.
std::string keys_as_json(const Family& family, const std::vector<Key>& keys) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Key& key : keys) {
        nlohmann::ordered_json features;
        for (std::size_t i = 0; i < key.size(); ++i)
            features[family.features[i].name] = value_of(family, key, i);
        rows.push_back({{"key", key_text(family, key)}, {"features", std::move(features)}});
    }
    return nlohmann::ordered_json{{"family", family.name}, {"keys", std::move(rows)}}.dump(2) + "\n";
}

/// The keys of a manifest that gobo build wrote.
Result<std::vector<Key>> keys_of_manifest(const World& world, const LoadedFamily& family,
                                          const std::string& path) {
    GOBO_TRY(const std::string text, world.disk.read(path));
    const auto manifest = nlohmann::json::parse(text, nullptr, false);
    const auto is_text = [](const nlohmann::json& object, const char* name) {
        return object.is_object() && object.contains(name) && object[name].is_string();
    };
    const bool is_manifest =
        is_text(manifest, "family") && is_text(manifest, "dialect") && manifest.contains("permutations") &&
        std::ranges::all_of(manifest["permutations"], [&](const auto& row) { return is_text(row, "key"); });
    if (!is_manifest) return fail(Place{path}, {}, "is no manifest", "name the .json that gobo build wrote");
    if (manifest["family"] != family.family.name)
        return fail(Place{path}, {},
                    fmt::format("is of the family '{}', not of '{}'", manifest["family"].get<std::string>(),
                                family.family.name));
    std::vector<NamedKey> named;
    for (const auto& row : manifest["permutations"]) named.push_back({row["key"].get<std::string>(), {path}});
    Selection selection;
    selection.keys = std::move(named);
    if (selection.keys.empty()) return std::vector<Key>{};
    return select(family.family, selection, name_of(family.dialect));
}

Compared compare(const std::vector<Key>& asked, const std::vector<Key>& built) {
    const std::set<Key> all_asked(asked.begin(), asked.end());
    const std::set<Key> all_built(built.begin(), built.end());
    Compared compared;
    for (const Key& key : asked)
        (all_built.contains(key) ? compared.warm_up : compared.missing).push_back(key);
    for (const Key& key : built)
        if (!all_asked.contains(key)) compared.never_used.push_back(key);
    return compared;
}

/// What the key says of the pipeline that its program belongs to: {"sides": "two"}.
nlohmann::ordered_json pipeline_state(const Family& family, const Key& key) {
    nlohmann::ordered_json state = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < key.size(); ++i)
        if (family.features[i].role == Role::pipeline)
            state[family.features[i].name] = value_of(family, key, i);
    return state;
}

std::string compared_text(const Family& family, const Compared& compared, bool only_warm_up) {
    std::string text;
    const auto add = [&](const char* what, const std::vector<Key>& keys) {
        for (const Key& key : keys) text += fmt::format("{}{}\n", what, key_text(family, key));
    };
    if (only_warm_up) {
        add("", compared.warm_up);
    } else {
        add("missing: ", compared.missing);
        add("never used: ", compared.never_used);
    }
    return text;
}

std::string compared_json(const Family& family, const Compared& compared) {
    const auto rows = [&](const std::vector<Key>& keys) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const Key& key : keys)
            list.push_back({{"key", key_text(family, key)}, {"pipeline", pipeline_state(family, key)}});
        return list;
    };
    const nlohmann::ordered_json document = {{"family", family.name},
                                             {"missing", rows(compared.missing)},
                                             {"never_used", rows(compared.never_used)},
                                             {"warm_up", rows(compared.warm_up)}};
    return document.dump(2) + "\n";
}

Result<Outcome> run(const ListOptions& options, const World& world) {
    GOBO_TRY(LoadedFamily loaded, load_family(world, options.family, options.dialect));
    const Family& family = loaded.family;
    // Also of more than can be listed.
    if (options.count && options.shard.empty() && options.against.empty()) {
        GOBO_TRY(const Selection selection, load_selection(world, loaded, options));
        GOBO_TRY(const auto count, count_selected(family, selection, name_of(loaded.dialect)));
        return Outcome{count.text() + "\n"};
    }
    SelectionOptions selected = options;
    selected.may_hold_none = !options.against.empty();  // an application that asked for nothing
    GOBO_TRY(const auto keys, load_keys(world, loaded, selected));
    if (!options.against.empty()) {
        GOBO_TRY(const auto built, keys_of_manifest(world, loaded, options.against));
        const Compared compared = compare(keys, built);
        const std::string text = compared_text(family, compared, options.warm_up);
        if (options.count) return Outcome{fmt::format("{}\n", std::ranges::count(text, '\n'))};
        return Outcome{options.json ? compared_json(family, compared) : text};
    }
    if (options.count) return Outcome{fmt::format("{}\n", keys.size())};
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
             {"--recorded", "FILE", "Keys that an application asked for, as <gobo/record.hpp> keeps them",
              &options->key_files},
             {"--against", "FILE",
              "A manifest that gobo build wrote: print which of the keys it lacks, and which it has besides",
              &options->against},
             {"--warm-up",
              "",
              "Print the keys that it has: those to make ready at the start",
              &options->warm_up,
              {.needs = "--against"}},
             dialect_option(options->dialect)},
            {selection_options(*options)},
            "  gobo list lit                                  the family's default set\n"
            "  gobo list lit --all --where 'point <= 2' --count\n"
            "  gobo list lit --cover 3 --over fog,fog_distance,shading\n"
            "  gobo list lit --key 'point=3 fog=linear'       the canonical form of a key\n"
            "  gobo list lit --recorded game.keys --scene level.gltf --against generated/lit.json",
            [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
