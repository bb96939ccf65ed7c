#include "lab/oracle/settings.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "family/key.hpp"
#include "family/selection.hpp"

namespace gobo::oracle {
namespace {

constexpr std::array at_run_time = {"switched", "looped"};
constexpr std::array counts = {"directional",         "point",         "spot",        "homogeneous",
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
    selection.where = fmt::format("directional + point + spot + homogeneous <= {}", kSwitchedLights);
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

std::vector<Model> models_of(const Family& family, const Key& key) {
    std::vector<Model> models;
    const Result<std::vector<Key>> settings = settings_of(family, key);
    for (const Key& setting : settings ? *settings : std::vector<Key>{})
        if (const auto model = model_of(family, setting)) models.push_back(*model);
    return models;
}

}  // namespace gobo::oracle
