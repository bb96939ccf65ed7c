#include "uber_values.hpp"

#include <array>

#include <fmt/format.h>

#include "family/key.hpp"

namespace gobo::scene {
namespace {

/// A kind of light of `lit`: its feature, its block, which of its lights cast shadows, and what it is to the
/// ubershader.
struct LightFeature {
    const char* feature;
    const char* block;
    const char* shadows;
    bool is_local;
    bool is_spot;
};

constexpr std::array kinds = {
    LightFeature{"directional", "DirectionalLights", "directional_shadows", false, false},
    LightFeature{"point", "PointLights", "point_shadows", true, false},
    LightFeature{"spot", "SpotLights", "spot_shadows", true, true},
    LightFeature{"directional_or_point", "DirectionalOrPointLights", nullptr, false, false}};

/// The kinds in the order in which the block `Shadows` has them.
constexpr std::array<std::size_t, 3> shadow_order = {0, 2, 1};

constexpr const char* switched = "switched";

int value_of(const Family& family, const Key& key, const char* feature) {
    const auto index = family.index_of(feature);
    return index ? key[static_cast<std::size_t>(*index)] : 0;
}

void set(std::vector<RenderValue>& values, std::string name, double number) {
    values.push_back({std::move(name), "", {number}, {}});
}

/// Values under other names: those that begin with `from` begin with `to`.
void rename(const std::vector<RenderValue>& given, const std::string& from, const std::string& to,
            std::vector<RenderValue>& values) {
    for (const RenderValue& value : given) {
        if (!value.name.starts_with(from)) continue;
        RenderValue renamed = value;
        renamed.name = to + value.name.substr(from.size());
        values.push_back(std::move(renamed));
    }
}

/// Where a light of a permutation stands: how many lights stand before it, of its kind and of all, and before
/// its shadow.
struct Place {
    int of_kind = 0;
    int of_all = 0;
    int shadow = -1;  ///< it casts none
};

/// A light under the name that the ubershader has for it.
void add_light(const std::vector<RenderValue>& given, const LightFeature& kind, const Place& place,
               const std::string& to, std::vector<RenderValue>& values) {
    rename(given, fmt::format("{}.lights[{}].", kind.block, place.of_kind), to, values);
    rename(given, fmt::format("LightAmbients.colors[{}]", place.of_all), to + "ambient", values);
    set(values, to + "isEnabled", 1);
    set(values, to + "isLocal", kind.is_local ? 1 : 0);
    set(values, to + "isSpot", kind.is_spot ? 1 : 0);
    set(values, to + "isDirectionalOrPoint", kind.shadows == nullptr ? 1 : 0);
    set(values, to + "isShadowed", place.shadow >= 0 ? 1 : 0);
}

/// The shadow of a light under the names that the ubershader has for it.
void add_shadow(const std::vector<RenderValue>& given, const Place& place, const std::string& to,
                std::vector<RenderValue>& values) {
    rename(given, fmt::format("Shadows.shadows[{}].", place.shadow), to + "shadow.", values);
}

/// How many shadows stand before those of a kind in the block `Shadows`.
int shadows_before(const Family& lit, const Key& key, std::size_t kind) {
    int count = 0;
    for (const std::size_t other : shadow_order) {
        if (other == kind) break;
        count += value_of(lit, key, kinds[other].shadows);
    }
    return count;
}

/// Calls visit(kind, place, names) for each light that the key counts, with the names of its members among
/// the looped and, as far as it has room, the switched lights.
template <class Visit>
void for_each_light(const Family& lit, const Key& key, Visit visit) {
    Place place;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const LightFeature& kind = kinds[k];
        const int count = value_of(lit, key, kind.feature);
        const int shadowed = kind.shadows == nullptr ? 0 : value_of(lit, key, kind.shadows);
        for (place.of_kind = 0; place.of_kind < count; ++place.of_kind, ++place.of_all) {
            place.shadow = place.of_kind < shadowed ? shadows_before(lit, key, k) + place.of_kind : -1;
            visit(kind, place, fmt::format("LoopedLights.{}[{}].", kind.feature, place.of_kind));
            if (place.of_all < kSwitchedLights)
                visit(kind, place, fmt::format("SwitchedLights.lights[{}].", place.of_all));
        }
    }
}

void add_lights(const Family& lit, const Key& key, const std::vector<RenderValue>& given,
                std::vector<RenderValue>& values) {
    for (int i = 0; i < kSwitchedLights; ++i)
        set(values, fmt::format("SwitchedLights.lights[{}].isEnabled", i), 0);
    for (const LightFeature& kind : kinds)
        set(values, fmt::format("Switches.{}", kind.feature), value_of(lit, key, kind.feature));
    for_each_light(lit, key, [&](const LightFeature& kind, const Place& place, const std::string& to) {
        add_light(given, kind, place, to, values);
        add_shadow(given, place, to, values);
    });
}

/// What the ubershader has in another block than `lit`.
void add_moved(const Family& lit, const Key& key, const std::vector<RenderValue>& given,
               std::vector<RenderValue>& values) {
    if (value_of(lit, key, "material") == 0) rename(given, "Material.", "Materials.rows[0].", values);
    rename(given, "ToonThresholds.", "Toon.", values);
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
        if (feature.kind ==
            FeatureKind::count) {  // what counted lights ask for, all lights may need (uber.toml)
            const bool stands_in = feature.name == "directional" || feature.name == "directional_shadows" ||
                                   feature.name == "spot";
            result[i] = stands_in ? 1 : 0;
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
    add_moved(lit, key, given, values);
    add_lights(lit, key, given, values);
    return values;
}

std::vector<RenderValue> uber_shadow_values(const Family& lit, const Key& key,
                                            const std::vector<RenderValue>& shadows) {
    std::vector<RenderValue> values;
    for_each_light(lit, key, [&](const LightFeature&, const Place& place, const std::string& to) {
        add_shadow(shadows, place, to, values);
    });
    return values;
}

}  // namespace gobo::scene
