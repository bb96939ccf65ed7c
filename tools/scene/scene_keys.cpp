#include "scene/scene_keys.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"

namespace gobo::scene {
namespace {

constexpr int largest_bucket = 1'000'000;

/// The least bucket that is enough, but never more than the family has; the count itself where none is.
int bucketed(int count, int most, const Buckets& buckets) {
    const auto bucket = std::lower_bound(buckets.begin(), buckets.end(), count);
    return bucket == buckets.end() ? count : std::min(*bucket, most);
}

/// Puts one effect that is in into the key; says why where the family cannot.
std::string add_effect(const Family& family, const Effect& effect, Key& key) {
    const auto index = family.index_of(effect.feature);
    if (!index) return "called for but not yet in the family";
    const Feature& feature = family.features[static_cast<std::size_t>(*index)];
    int& value = key[static_cast<std::size_t>(*index)];
    if (feature.kind == FeatureKind::count) {
        const auto most = static_cast<int>(feature.values.size()) - 1;
        if (value == most) return fmt::format("called for but beyond the {} of the family", most);
        ++value;
        return {};
    }
    const auto wanted = feature.index_of(effect.value);
    if (!wanted) return fmt::format("{} is called for but not yet in the family", effect.value);
    value = *wanted;
    return {};
}

bool is_light(const Effect& effect) {
    return effect.feature == "directional" || effect.feature == "point" || effect.feature == "spot";
}

/// Rounds light counts up. Returns how many lights the permutation shades.
int apply_buckets(const Family& family, const Buckets& buckets, Key& key) {
    int shaded = 0;
    for (const char* name : {"directional", "point", "spot"}) {
        const auto index = family.index_of(name);
        if (!index) continue;
        const Feature& feature = family.features[static_cast<std::size_t>(*index)];
        if (feature.kind != FeatureKind::count) continue;
        int& value = key[static_cast<std::size_t>(*index)];
        value = bucketed(value, static_cast<int>(feature.values.size()) - 1, buckets);
        shaded += value;
    }
    return shaded;
}

DrawKey key_of(const Family& family, const Draw& draw, const Buckets& buckets, std::string_view dialect) {
    DrawKey result;
    result.key = default_key(family);
    for (const Effect& effect : draw.effects) {
        if (!effect.is_in) continue;
        const std::string why = add_effect(family, effect, result.key);
        if (!why.empty()) result.missing.push_back(fmt::format("{}: {}", effect.name, why));
        result.lights += is_light(effect) && why.empty() ? 1 : 0;
    }
    result.shaded_lights = apply_buckets(family, buckets, result.key);
    result.key = canonical(family, std::move(result.key), dialect);
    return result;
}

}  // namespace

Result<Buckets> parse_buckets(std::string_view text) {
    Buckets buckets;
    for (const std::string& part : split(text, ',')) {
        int count = -1;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), count);
        const bool is_number = error == std::errc() && end == part.data() + part.size();
        const bool rises = buckets.empty() || count > buckets.back();
        if (!is_number || count < 0 || count > largest_bucket || !rises) {
            return fail(Fault::usage,
                        fmt::format("--bucket-lights: '{}' is no rising list of light counts", text),
                        "write it like 0,1,2,4,8");
        }
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
        if (!draw.excluded.empty()) {
            keys.emplace_back();
            continue;
        }
        DrawKey key = key_of(family, draw, buckets, dialect);
        if (const Rule* rule = forbidding_rule(family, key.key, dialect)) {
            return fail(Fault::input,
                        fmt::format("'{}' calls for '{}', which family '{}' forbids: {}", draw.name,
                                    key_text(family, key.key), family.name, rule->reason));
        }
        keys.emplace_back(std::move(key));
    }
    return keys;
}

std::vector<Key> distinct_keys(const std::vector<std::optional<DrawKey>>& draws) {
    std::vector<Key> keys;
    for (const auto& draw : draws)
        if (draw) keys.push_back(draw->key);
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

}  // namespace gobo::scene
