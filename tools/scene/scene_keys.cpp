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

/// What the draw asks for, before light counts are rounded up.
DrawKey needs_of(const Family& family, const Draw& draw) {
    DrawKey result;
    result.name = draw.name;
    result.effects = default_key(family);
    for (std::size_t i = 0; i < result.effects.size(); ++i)
        result.effects[i] -= family.features[i].lowest;  // no light
    for (const Effect& effect : draw.effects) {
        if (!effect.is_in) continue;
        const std::string why = add_effect(family, effect, result.effects);
        if (!why.empty()) result.missing.push_back(fmt::format("{}: {}", effect.name, why));
        const bool is_light = std::ranges::find(kLightKinds, effect.feature) != kLightKinds.end();
        result.lights += is_light && why.empty() ? 1 : 0;
    }
    for (int& value : result.effects) value = std::max(value, 0);
    return result;
}

/// Decides the key. Fault::input where a rule forbids it.
Result<void> round_up(const Family& family, const Buckets& buckets, std::string_view dialect, DrawKey& draw) {
    draw.key = draw.effects;
    draw.shaded_lights = apply_buckets(family, buckets, draw.key);
    draw.key = canonical(family, std::move(draw.key), dialect);
    if (const Rule* rule = forbidding_rule(family, draw.key, dialect))
        return fail(Fault::input, fmt::format("'{}' needs '{}', which family '{}' forbids: {}", draw.name,
                                              key_text(family, draw.key), family.name, rule->reason));
    return {};
}

/// Nothing for an excluded draw.
Result<std::optional<DrawKey>> key_for_draw(const Family& family, const Draw& draw, const Buckets& buckets,
                                            std::string_view dialect) {
    if (!draw.excluded.empty()) return std::nullopt;
    DrawKey key = needs_of(family, draw);
    GOBO_TRY_DO(round_up(family, buckets, dialect, key));
    return key;
}

/// The draws with other buckets.
Result<std::vector<std::optional<DrawKey>>> rounded(const Family& family,
                                                    std::vector<std::optional<DrawKey>> draws,
                                                    const Buckets& buckets, std::string_view dialect) {
    for (auto& draw : draws)
        if (draw) GOBO_TRY_DO(round_up(family, buckets, dialect, *draw));
    return draws;
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

/// What notes_on_scene() tells, gathered draw after draw.
class SceneNotes {
  public:
    explicit SceneNotes(const Scene& scene)
        : scene_(scene), not_drawn_(scene.not_read.begin(), scene.not_read.end()) {
        has_casters_ = std::ranges::any_of(
            place_lights(scene), [](const PlacedLight& light) { return light.light->casts_shadow; });
    }

    void add(const Draw& draw, const std::optional<DrawKey>& key) {
        if (key)
            for (const std::string& missing : key->missing)
                not_drawn_.insert(missing.substr(0, missing.find(": ")));
        if (!draw.excluded.empty()) {
            ++excluded_[draw.excluded];
            return;
        }
        is_any_drawn_ = true;
        is_any_seen_ = is_any_seen_ || !is_black(draw);
        // It would cast a shadow if it were not blended.
        blended_ += has_casters_ && !casts_shadow(scene_, draw) ? 1 : 0;
    }
    [[nodiscard]] std::vector<std::string> lines() const;

  private:
    /// Whether it has neither a light nor an environment nor an emission of its own.
    [[nodiscard]] bool is_black(const Draw& draw) const {
        const auto lights = [](const Effect& effect) {
            return effect.is_in && (effect.feature == "ambient" || effect.feature == "reflection" ||
                                    std::ranges::find(kLightKinds, effect.feature) != kLightKinds.end());
        };
        const Material& material = material_of(scene_, draw);
        return !material.unlit && material.emission == glm::dvec3(0) &&
               std::ranges::none_of(draw.effects, lights);
    }

    const Scene& scene_;
    std::set<std::string> not_drawn_;
    std::map<std::string, std::size_t> excluded_;  ///< how often each reason holds
    std::size_t blended_ = 0;
    bool has_casters_ = false;
    bool is_any_drawn_ = false;
    bool is_any_seen_ = false;
};

std::vector<std::string> SceneNotes::lines() const {
    std::vector<std::string> parts = with_runs({not_drawn_.begin(), not_drawn_.end()});
    if (blended_ > 0)
        parts.push_back(fmt::format("shadows of {} blended draw{}", blended_, blended_ == 1 ? "" : "s"));
    for (const auto& [reason, count] : excluded_)
        parts.push_back(fmt::format("{} draw{} ({})", count, count == 1 ? "" : "s", reason));
    std::vector<std::string> notes;
    if (!parts.empty())
        notes.push_back(fmt::format("{}: not drawn: {}", scene_.path, fmt::join(parts, ", ")));
    const bool is_dark = scene_.ambient == glm::dvec3(0) && is_any_drawn_ && !is_any_seen_;
    if (!scene_.has_no_light && is_dark)
        notes.push_back(fmt::format("{}: nothing lights this scene", scene_.path));
    const auto needs_physical = [](const Material& material) {
        return !material.unlit && (material.is_textured || material.is_metal);
    };
    std::vector<std::string> offers;
    if (std::ranges::any_of(scene_.materials, needs_physical))
        offers.emplace_back("draws its textures and metals as they are");
    if (scene_.has_no_light && !scene_.meshes.empty())
        offers.emplace_back("lights it with a studio, as it has no light");
    if (!scene_.is_physical && !offers.empty())
        notes.push_back(fmt::format("{}: family pbr {}", scene_.path, fmt::join(offers, " and ")));
    for (std::string& note : notes) note = one_line(note);
    return notes;
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
        GOBO_TRY(std::optional<DrawKey> key, key_for_draw(family, draw, buckets, dialect));
        keys.push_back(std::move(key));
    }
    return keys;
}

Result<SceneKeys> keys_for_scene(const Family& family, const SceneDraws& draws, const Buckets& buckets,
                                 std::string_view dialect) {
    SceneKeys scene;
    SceneNotes notes(draws.scene());
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Draw draw = draws.judged(i);
        GOBO_TRY(std::optional<DrawKey> key, key_for_draw(family, draw, buckets, dialect));
        notes.add(draw, key);
        if (key) key->missing = std::vector<std::string>();  // its memory, too
        scene.keys.push_back(std::move(key));
    }
    scene.notes = notes.lines();
    return scene;
}

std::vector<std::string> missing_effects(const Family& family, const Draw& draw) {
    return draw.excluded.empty() ? needs_of(family, draw).missing : std::vector<std::string>();
}

std::vector<std::string> notes_on_scene(const Scene& scene, const std::vector<Draw>& draws,
                                        const std::vector<std::optional<DrawKey>>& keys) {
    SceneNotes notes(scene);
    for (std::size_t i = 0; i < draws.size(); ++i) notes.add(draws[i], keys[i]);
    return notes.lines();
}

std::vector<Key> distinct_keys(const std::vector<std::optional<DrawKey>>& draws) {
    std::set<Key> keys;
    for (const auto& draw : draws)
        if (draw) keys.insert(draw->key);
    return {keys.begin(), keys.end()};
}

Result<Funnel> measure_funnel(const Family& family, const std::vector<std::optional<DrawKey>>& draws,
                              const Buckets& buckets, std::string_view dialect) {
    GOBO_TRY(const auto exact, rounded(family, draws, {}, dialect));
    GOBO_TRY(const auto bucketed, rounded(family, draws, buckets, dialect));
    Funnel funnel;
    for (const Feature& feature : family.features) funnel.full_product *= feature.values.size();
    GOBO_TRY(const KeySpace space, KeySpace::make(family, dialect, {{}, {}, true}));
    funnel.valid = space.count();
    funnel.draws = static_cast<std::size_t>(
        std::ranges::count_if(exact, [](const auto& draw) { return draw.has_value(); }));
    funnel.needed = distinct_keys(exact).size();
    funnel.bucketed = distinct_keys(bucketed).size();
    return funnel;
}

Result<std::vector<BucketingRow>> compare_bucketings(const Family& family,
                                                     const std::vector<std::optional<DrawKey>>& draws,
                                                     const Buckets& chosen, std::string_view dialect) {
    std::vector<Buckets> bucketings = {{}, {0, 1, 2, 4, 8}, {0, 2, 8}, {0, 8}, {8}};
    if (std::ranges::find(bucketings, chosen) == bucketings.end()) bucketings.push_back(chosen);
    std::vector<BucketingRow> rows;
    for (const Buckets& buckets : bucketings) {
        GOBO_TRY(const auto keys, rounded(family, draws, buckets, dialect));
        BucketingRow& row = rows.emplace_back(BucketingRow{buckets, distinct_keys(keys).size(), 0, 0});
        for (const auto& key : keys) {
            row.lights += key ? key->lights : 0;
            row.shaded_lights += key ? key->shaded_lights : 0;
        }
    }
    return rows;
}

}  // namespace gobo::scene
