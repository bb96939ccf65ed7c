#include "gobo/shard_run.hpp"

#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "core/digest.hpp"
#include "core/text.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kKeys = "selection of keys";
constexpr const char* kBuild = "build of gobo";
constexpr const char* kFiles = "files";

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

/// By name, a digest of the family file, its bases, and the templates and pieces of any key. Names hold no
/// folder that a checkout lies in, and what is embedded is told by kBuild.
Json digests_of_files(const World& world, const LoadedFamily& family,
                      const std::vector<std::string>& family_files) {
    const auto name_of_file = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
    std::map<std::string, std::string> texts = {{name_of_file(family.family.path), family.text}};
    for (const std::string& path : family_files)
        if (path != family.family.path) texts[name_of_file(path)] += world.disk.read(path).value_or("");
    for (const auto& [path, name] : files_of_all_keys(family.family, family.search, family.dialect))
        texts[name] += world.disk.read(path).value_or("");
    Json digests = Json::object();
    for (const auto& [name, text] : texts) digests[name] = hex(digest_of(text));
    return digests;
}

/// The first member that is another in one of two objects; empty where there is none.
std::string first_other(const Json& first, const Json& own) {
    if (!first.is_object() || !own.is_object()) return "";
    for (const Json* named : {&first, &own})
        for (const auto& [name, unused] : named->items())
            if (first.value(name, Json()) != own.value(name, Json())) return name;
    return "";
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

std::string run_of_shards(const World& world, const LoadedFamily& family,
                          const std::vector<std::string>& family_files, const std::vector<Key>& all) {
    Json run = {{"family", family.family.name}, {"dialect", name_of(family.dialect)}};
    const std::set<std::string> others = left_out();
    for (const auto& [name, value] : world.given)
        if (!others.contains(name)) run[name] = value;
    std::string keys;
    for (const Key& key : all) keys += key_text(family.family, key) + "\n";
    run[kKeys] = hex(digest_of(keys));
    run[kBuild] = hex(digest_of(program_identity()));
    run[kFiles] = digests_of_files(world, family, family_files);
    return run.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string difference_of_runs(const std::string& first, const std::string& run) {
    if (run == first) return "";
    Json expected = Json::parse(first, nullptr, false);
    Json own = Json::parse(run, nullptr, false);
    if (!expected.is_object() || !own.is_object()) return "other keys or options";
    const Json first_files = expected.value(kFiles, Json());
    const Json own_files = own.value(kFiles, Json());
    // Another option is why the files are others.
    expected.erase(kFiles);
    own.erase(kFiles);
    if (const std::string name = first_other(expected, own); !name.empty())
        return another(name, expected.value(name, Json()), own.value(name, Json()));
    if (const std::string file = first_other(first_files, own_files); !file.empty())
        return fmt::format("another file '{}'", file);
    return "other keys or options";
}

}  // namespace gobo
