#include "scene_picture/uber_values.hpp"

#include <array>

#include <fmt/format.h>

#include "family/key.hpp"

namespace gobo::scene {
namespace {

/// A kind of light of `lit`: its feature, its block, and what it is to the ubershader.
struct LightFeature {
    const char* feature;
    const char* block;
    bool is_local;
    bool is_spot;
};

constexpr std::array kinds = {LightFeature{"directional", "DirectionalLights", false, false},
                              LightFeature{"point", "PointLights", true, false},
                              LightFeature{"spot", "SpotLights", true, true}};

constexpr const char* switched = "switched";

int value_of(const Family& family, const Key& key, const char* feature) {
    const auto index = family.index_of(feature);
    return index ? key[static_cast<std::size_t>(*index)] : 0;
}

void set(std::vector<RenderValue>& values, std::string name, double number) {
    values.push_back({std::move(name), "", {number}, {}});
}

/// A light's values under other names.
void add_light(const std::vector<RenderValue>& given, const std::string& from, const std::string& to,
               std::vector<RenderValue>& values) {
    for (const RenderValue& value : given) {
        if (!value.name.starts_with(from)) continue;
        RenderValue renamed = value;
        const std::string member = value.name.substr(from.size());
        renamed.name = to + (member == "direction" ? "position" : member);
        if (member == "direction" && renamed.source.empty()) renamed.numbers.push_back(0);  // a vec4's w
        values.push_back(std::move(renamed));
    }
}

/// A light among the switched lights.
void add_switched_light(const std::vector<RenderValue>& given, const std::string& from,
                        const LightFeature& kind, int place, std::vector<RenderValue>& values) {
    const std::string to = fmt::format("SwitchedLights.lights[{}].", place);
    add_light(given, from, to, values);
    set(values, to + "isEnabled", 1);
    set(values, to + "isLocal", kind.is_local ? 1 : 0);
    set(values, to + "isSpot", kind.is_spot ? 1 : 0);
}

}  // namespace

int lights_of(const Family& lit, const Key& key) {
    int count = 0;
    for (const LightFeature& kind : kinds) count += value_of(lit, key, kind.feature);
    return count;
}

Key uber_key(const Family& uber, const Family& lit, const Key& key, UberLights lights) {
    Key result = default_key(uber);
    for (std::size_t i = 0; i < uber.features.size(); ++i) {
        const Feature& feature = uber.features[i];
        const auto own = lit.index_of(feature.name);
        if (feature.name == "lighting") {
            result[i] = *feature.index_of(lights == UberLights::switched ? switched : "looped");
        } else if (const auto value = feature.index_of(switched)) {
            result[i] = *value;
        } else if (own) {
            result[i] = key[static_cast<std::size_t>(*own)];  // the values of lit come first in uber
        }
    }
    return canonical(uber, result, "450");
}

std::vector<RenderValue> uber_values(const Family& uber, const Family& lit, const Key& key,
                                     std::vector<RenderValue> values) {
    const std::vector<RenderValue> given = values;
    for (std::size_t i = 0; i < lit.features.size(); ++i) {
        const Feature& feature = lit.features[i];
        const auto index = uber.index_of(feature.name);
        const bool is_switched = index && uber.features[static_cast<std::size_t>(*index)].index_of(switched);
        if (is_switched) set(values, "Switches." + feature.name, key[i]);
    }
    int place = 0;
    for (int i = 0; i < kSwitchedLights; ++i)
        set(values, fmt::format("SwitchedLights.lights[{}].isEnabled", i), 0);
    for (const LightFeature& kind : kinds) {
        const int count = value_of(lit, key, kind.feature);
        set(values, fmt::format("Switches.{}", kind.feature), count);
        for (int i = 0; i < count; ++i) {
            const std::string from = fmt::format("{}.lights[{}].", kind.block, i);
            add_light(given, from, fmt::format("LoopedLights.{}[{}].", kind.feature, i), values);
            if (place < kSwitchedLights) add_switched_light(given, from, kind, place++, values);
        }
    }
    return values;
}

}  // namespace gobo::scene
