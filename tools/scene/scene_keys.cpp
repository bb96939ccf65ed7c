#include "scene/scene_keys.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "family/key_space.hpp"

namespace gobo::scene {
namespace {

constexpr int kLargestBucket = 1'000'000;

/// Puts one effect that is in into the key; says why where the family cannot.
std::string add_effect(const Family& family, const Effect& effect, Key& key) {
    const auto index = family.index_of(effect.feature);
    if (!index) return "needed, but not yet in the family";
    const Feature& feature = family.features[static_cast<std::size_t>(*index)];
    int& value = key[static_cast<std::size_t>(*index)];
    if (feature.kind == FeatureKind::count) {
        const auto most = static_cast<int>(feature.values.size()) - 1;
        if (value == most)
            return fmt::format("needed, but beyond the {} of the family", feature.values.back());
        ++value;
        return {};
    }
    const auto wanted = feature.index_of(effect.value);
    if (!wanted) return fmt::format("{} is needed, but not yet in the family", effect.value);
    value = *wanted;
    return {};
}

/// Rounds light counts up: to the least bucket that is enough, but never beyond the family's largest; a count
/// above all buckets stays. Returns how many lights the permutation shades.
int apply_buckets(const Family& family, const Buckets& buckets, Key& key) {
    int shaded = 0;
    for (const char* name : kLightKinds) {
        const auto index = family.index_of(name);
        if (!index) continue;
        const Feature& feature = family.features[static_cast<std::size_t>(*index)];
        if (feature.kind != FeatureKind::count) continue;
        int& value = key[static_cast<std::size_t>(*index)];
        const auto bucket = std::ranges::lower_bound(buckets, feature.lowest + value);
        if (bucket != buckets.end())
            value = std::min(*bucket - feature.lowest, static_cast<int>(feature.values.size()) - 1);
        shaded += feature.lowest + value;
    }
    return shaded;
}

DrawKey key_of(const Family& family, const Draw& draw, const Buckets& buckets, std::string_view dialect) {
    DrawKey result;
    result.key = default_key(family);
    for (std::size_t i = 0; i < result.key.size(); ++i)
        result.key[i] -= family.features[i].lowest;  // no light
    for (const Effect& effect : draw.effects) {
        if (!effect.is_in) continue;
        const std::string why = add_effect(family, effect, result.key);
        if (!why.empty()) result.missing.push_back(fmt::format("{}: {}", effect.name, why));
        const bool is_light = std::ranges::find(kLightKinds, effect.feature) != kLightKinds.end();
        result.lights += is_light && why.empty() ? 1 : 0;
    }
    for (int& value : result.key) value = std::max(value, 0);
    result.shaded_lights = apply_buckets(family, buckets, result.key);
    result.key = canonical(family, std::move(result.key), dialect);
    return result;
}

/// "point 8 to 31" in place of these names, each of which is words and a number; others stay. In order.
std::vector<std::string> with_runs(const std::vector<std::string>& names) {
    std::map<std::string, std::set<int>> numbers;  // by the words before them; none: the name is no such
    for (const std::string& name : names) {
        const std::size_t space = name.rfind(' ');
        const auto number = number_from<int>(name.substr(space + 1));
        if (space != std::string::npos && number)
            numbers[name.substr(0, space)].insert(*number);
        else
            numbers[name];
    }
    std::vector<std::string> texts;
    for (const auto& [words, own] : numbers) {
        if (own.empty()) texts.push_back(words);
        for (auto at = own.begin(); at != own.end();) {
            const int first = *at;
            int last = first;
            while (++at != own.end() && *at == last + 1) ++last;
            texts.push_back(last == first ? fmt::format("{} {}", words, first)
                                          : fmt::format("{} {} to {}", words, first, last));
        }
    }
    return texts;
}

/// How many draws would cast a shadow if they were not blended.
std::size_t blended_before_shadows(const Scene& scene, const std::vector<Draw>& draws) {
    const std::vector<PlacedLight> lights = place_lights(scene);
    if (std::ranges::none_of(lights, [](const PlacedLight& light) { return light.light->casts_shadow; }))
        return 0;
    return static_cast<std::size_t>(std::ranges::count_if(
        draws, [&](const Draw& draw) { return draw.excluded.empty() && !casts_shadow(scene, draw); }));
}

/// Whether every draw is black: none has a light, an environment or an emission of its own.
bool is_dark(const Scene& scene, const std::vector<Draw>& draws) {
    const auto is_drawn = [](const Draw& draw) { return draw.excluded.empty(); };
    const auto is_black = [&](const Draw& draw) {
        const auto lights = [](const Effect& effect) {
            return effect.is_in && (effect.feature == "ambient" || effect.feature == "reflection" ||
                                    std::ranges::find(kLightKinds, effect.feature) != kLightKinds.end());
        };
        const Material& material = material_of(scene, draw);
        return !is_drawn(draw) || (!material.unlit && material.emission == glm::dvec3(0) &&
                                   std::ranges::none_of(draw.effects, lights));
    };
    return scene.ambient == glm::dvec3(0) && std::ranges::any_of(draws, is_drawn) &&
           std::ranges::all_of(draws, is_black);
}

}  // namespace

Reading reading_for(const Family& family) {
    const bool is_physical = family.index_of(kMapFeatures.front()).has_value();
    return is_physical ? Reading::physical : Reading::classic;
}

Result<Buckets> parse_buckets(std::string_view text) {
    Buckets buckets;
    const auto refused =
        fail(Fault::usage, fmt::format("--bucket-lights: '{}' is not a rising list of light counts", text),
             "write it like 0,1,2,4,8");
    if (!text.empty() && has_empty_part(text, ',')) return refused;
    for (const std::string& part : split(text, ',')) {
        const int count = number_from<int>(part).value_or(-1);
        const bool rises = buckets.empty() || count > buckets.back();
        if (count < 0 || count > kLargestBucket || !rises) return refused;
        buckets.push_back(count);
    }
    return buckets;
}

std::string buckets_text(const Buckets& buckets) {
    return buckets.empty() ? "every count" : fmt::format("{}", fmt::join(buckets, ","));
}

Result<std::vector<std::optional<DrawKey>>> keys_for_draws(const Family& family,
                                                           const std::vector<Draw>& draws,
                                                           const Buckets& buckets, std::string_view dialect) {
    std::vector<std::optional<DrawKey>> keys;
    for (const Draw& draw : draws) {
        auto& key = keys.emplace_back();
        if (!draw.excluded.empty()) continue;
        key = key_of(family, draw, buckets, dialect);
        if (const Rule* rule = forbidding_rule(family, key->key, dialect))
            return fail(Fault::input, fmt::format("'{}' needs '{}', which family '{}' forbids: {}", draw.name,
                                                  key_text(family, key->key), family.name, rule->reason));
    }
    return keys;
}

std::vector<std::string> notes_on_scene(const Scene& scene, const std::vector<Draw>& draws,
                                        const std::vector<std::optional<DrawKey>>& keys) {
    std::set<std::string> effects;
    std::map<std::string, std::size_t> excluded;  // how often each reason holds
    for (const Draw& draw : draws)
        if (!draw.excluded.empty()) ++excluded[draw.excluded];
    for (const auto& key : keys)
        if (key)
            for (const std::string& missing : key->missing)
                effects.insert(missing.substr(0, missing.find(": ")));
    effects.insert(scene.not_read.begin(), scene.not_read.end());
    std::vector<std::string> parts = with_runs({effects.begin(), effects.end()});
    if (const std::size_t count = blended_before_shadows(scene, draws))
        parts.push_back(fmt::format("shadows of {} blended draw{}", count, count == 1 ? "" : "s"));
    for (const auto& [reason, count] : excluded)
        parts.push_back(fmt::format("{} draw{} ({})", count, count == 1 ? "" : "s", reason));
    std::vector<std::string> notes;
    if (!parts.empty()) notes.push_back(fmt::format("{}: not drawn: {}", scene.path, fmt::join(parts, ", ")));
    if (!scene.has_no_light && is_dark(scene, draws))
        notes.push_back(fmt::format("{}: nothing lights this scene", scene.path));
    const auto needs_physical = [](const Material& material) {
        return !material.unlit && (material.is_textured || material.is_metal);
    };
    std::vector<std::string> offers;
    if (std::ranges::any_of(scene.materials, needs_physical))
        offers.emplace_back("draws its textures and metals as they are");
    if (scene.has_no_light && !scene.meshes.empty())
        offers.emplace_back("lights it with a studio, as it has no light");
    if (!scene.is_physical && !offers.empty())
        notes.push_back(fmt::format("{}: family pbr {}", scene.path, fmt::join(offers, " and ")));
    for (std::string& note : notes) note = one_line(note);
    return notes;
}

std::vector<Key> distinct_keys(const std::vector<std::optional<DrawKey>>& draws) {
    std::set<Key> keys;
    for (const auto& draw : draws)
        if (draw) keys.insert(draw->key);
    return {keys.begin(), keys.end()};
}

Result<Funnel> measure_funnel(const Family& family, const std::vector<Draw>& draws, const Buckets& buckets,
                              std::string_view dialect) {
    GOBO_TRY(const auto exact, keys_for_draws(family, draws, {}, dialect));
    GOBO_TRY(const auto rounded, keys_for_draws(family, draws, buckets, dialect));
    Funnel funnel;
    for (const Feature& feature : family.features) funnel.full_product *= feature.values.size();
    GOBO_TRY(const KeySpace space, KeySpace::make(family, dialect, {{}, {}, true}));
    funnel.valid = space.count();
    funnel.draws = static_cast<std::size_t>(
        std::ranges::count_if(exact, [](const auto& draw) { return draw.has_value(); }));
    funnel.needed = distinct_keys(exact).size();
    funnel.bucketed = distinct_keys(rounded).size();
    return funnel;
}

Result<std::vector<BucketingRow>> compare_bucketings(const Family& family, const std::vector<Draw>& draws,
                                                     const Buckets& chosen, std::string_view dialect) {
    std::vector<Buckets> bucketings = {{}, {0, 1, 2, 4, 8}, {0, 2, 8}, {0, 8}, {8}};
    if (std::ranges::find(bucketings, chosen) == bucketings.end()) bucketings.push_back(chosen);
    std::vector<BucketingRow> rows;
    for (const Buckets& buckets : bucketings) {
        GOBO_TRY(const auto keys, keys_for_draws(family, draws, buckets, dialect));
        BucketingRow& row = rows.emplace_back(BucketingRow{buckets, distinct_keys(keys).size(), 0, 0});
        for (const auto& key : keys) {
            row.lights += key ? key->lights : 0;
            row.shaded_lights += key ? key->shaded_lights : 0;
        }
    }
    return rows;
}

}  // namespace gobo::scene
