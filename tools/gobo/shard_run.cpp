#include "gobo/shard_run.hpp"

#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compose/dialect.hpp"
#include "core/digest.hpp"
#include "core/text.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kKeys = "selection of keys";
constexpr const char* kBuild = "build of gobo";

/// Options that results do not hang on, or that say which keys: those are told by kKeys. Any other counts.
std::set<std::string> left_out() {
    const std::vector<std::string> names = split(
        "--cache --cache-size --color --csv --diagnostics --dialect --figures --in-process --jobs --json "
        "--keep-stopped --output --quiet",
        ' ');
    std::set<std::string> all(names.begin(), names.end());
    SelectionOptions selection;
    for (const Option& option : selection_options(selection).options) all.insert(option.names);
    return all;
}

/// "another --gpu ('vega10', not 'navi21')".
std::string another(const std::string& name, const Json& first, const Json& own) {
    if (name == kKeys || name == kBuild) return "another " + name;
    const auto text = [](const Json& value) {
        return value.is_null()     ? "none"
               : value.is_string() ? fmt::format("'{}'", value.get<std::string>())
                                   : value.dump();
    };
    return fmt::format("another {} ({}, not {})", name, text(own), text(first));
}

}  // namespace

std::string run_of_shards(const World& world, const LoadedFamily& family, const std::vector<Key>& all) {
    Json run = {{"family", family.family.name}, {"dialect", name_of(family.dialect)}};
    const std::set<std::string> others = left_out();
    for (const auto& [name, value] : world.given)
        if (!others.contains(name)) run[name] = value;
    std::string keys;
    for (const Key& key : all) keys += key_text(family.family, key) + "\n";
    run[kKeys] = hex(digest_of(keys));
    run[kBuild] = hex(digest_of(program_identity()));
    return run.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string difference_of_runs(const std::string& first, const std::string& run) {
    if (run == first) return "";
    const Json expected = Json::parse(first, nullptr, false);
    const Json own = Json::parse(run, nullptr, false);
    if (expected.is_object() && own.is_object())
        for (const Json* named : {&expected, &own})
            for (const auto& [name, unused] : named->items())
                if (expected.value(name, Json()) != own.value(name, Json()))
                    return another(name, expected.value(name, Json()), own.value(name, Json()));
    return "other keys or options";
}

}  // namespace gobo
