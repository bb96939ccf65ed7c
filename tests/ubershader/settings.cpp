#include "settings.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "core/file_system.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"

namespace gobo::uber {
namespace {

const std::string source = GOBO_SOURCE_DIR "/";
const DiskFileSystem disk;

constexpr std::array at_run_time = {"switched", "looped"};
/// The counts at which keys stand whose lights are found at run time (uber.toml).
constexpr std::array stand_ins = {"directional", "directional_shadows", "spot"};
constexpr std::array counts = {"directional",         "point",         "spot",        "directional_or_point",
                               "directional_shadows", "point_shadows", "spot_shadows"};

bool is_switch(const std::string& value) {
    return std::find(at_run_time.begin(), at_run_time.end(), value) != at_run_time.end();
}

const std::string& value_of(const Feature& feature, int value) {
    return feature.values[static_cast<std::size_t>(value)];
}

bool finds_lights_at_run_time(const Family& family, const Key& key) {
    const auto lighting = family.index_of("lighting");
    if (!lighting) return false;
    const auto index = static_cast<std::size_t>(*lighting);
    return is_switch(value_of(family.features[index], key[index]));
}

/// Everything that a switch may choose, and the counts of lights that are found at run time.
Selection every_pair(const Family& family, const Key& key) {
    const bool has_counts = finds_lights_at_run_time(family, key);
    Selection selection;
    selection.cover = 2;
    selection.where = fmt::format("directional + point + spot + directional_or_point <= {}", kSwitchedLights);
    for (std::size_t i = 0; i < key.size(); ++i) {
        const Feature& feature = family.features[i];
        const bool is_count =
            has_counts && std::find(counts.begin(), counts.end(), feature.name) != counts.end();
        if (is_count || is_switch(value_of(feature, key[i]))) selection.over.push_back(feature.name);
        for (const std::string& value : feature.values)
            if (is_switch(value) && is_switch(value_of(feature, key[i])))
                selection.where += fmt::format(" && {} != {}", feature.name, value);
    }
    return selection;
}

}  // namespace

Family family() {
    const FindFamily find_lit = [](const std::string& name) -> Result<FamilyText> {
        const std::string path = "templates/" + name + ".toml";
        return FamilyText{disk.read(source + path).value(), path};
    };
    const std::string path = "tests/ubershader/uber.toml";
    return read_family(disk.read(source + path).value(), path, find_lit).value();
}

void add_pieces(SearchPath& search) {
    for (const char* folder : {"tests/ubershader/", "shader_lib/", "templates/"})
        search.add(disk, source + std::string(folder, std::strlen(folder) - 1), folder, false);
}

Key switched_key(const Family& family, const char* lighting) {
    Key key = default_key(family);
    for (std::size_t i = 0; i < key.size(); ++i) {
        const Feature& feature = family.features[i];
        if (const auto value = feature.index_of(feature.name == "lighting" ? lighting : "switched"))
            key[i] = *value;
        if (std::find(stand_ins.begin(), stand_ins.end(), feature.name) != stand_ins.end()) key[i] = 1;
    }
    return key;
}

bool has_switches(const Family& family, const Key& key) {
    for (std::size_t i = 0; i < key.size(); ++i)
        if (is_switch(value_of(family.features[i], key[i]))) return true;
    return false;
}

Result<std::vector<Key>> settings_of(const Family& family, const Key& key) {
    if (!has_switches(family, key)) return std::vector<Key>{key};
    const Selection selection = every_pair(family, key);
    Result<std::vector<Key>> settings = select(family, selection, "450");
    if (!settings) return settings;
    for (Key& setting : *settings)
        for (std::size_t i = 0; i < key.size(); ++i)
            if (const auto& over = selection.over;
                std::find(over.begin(), over.end(), family.features[i].name) == over.end())
                setting[i] = key[i];
    return settings;
}

std::vector<oracle::Model> models_of(const Family& family, const Key& key) {
    Family lit = family;  // settings are keys of `lit`: its features come first, and their values
    lit.name = "lit";
    std::vector<oracle::Model> models;
    const std::vector<Key> settings = settings_of(family, key).value();
    for (const Key& setting : settings) models.push_back(oracle::model_of(lit, setting).value());
    return models;
}

}  // namespace gobo::uber
