#include "budget/qualities.hpp"

#include <algorithm>
#include <set>

#include "family/key.hpp"

namespace gobo {
namespace {

/// The dialect that evaluation works on.
constexpr std::string_view kDialect = "450";

bool is_retired(const Feature& feature, int value) {
    const std::string& name = feature.values[static_cast<std::size_t>(value)];
    return std::find(feature.retired.begin(), feature.retired.end(), name) != feature.retired.end();
}

/// A family whose features may name a default apart from their order tells the order by listed(); otherwise
/// the default is the first.
template <class AnyFeature>
int first_listed(const AnyFeature& feature) {
    if constexpr (requires { feature.listed(); })
        return feature.listed().front();
    else
        return 0;
}

int value_count(const Family& family, int feature) {
    return static_cast<int>(family.features[static_cast<std::size_t>(feature)].values.size());
}

Key with(const Family& family, Key key, int feature, int value) {
    key[static_cast<std::size_t>(feature)] = value;
    return canonical(family, std::move(key), kDialect);
}

}  // namespace

int most_accurate_value(const Feature& feature) {
    return first_listed(feature);
}

std::vector<int> quality_features(const Family& family) {
    std::vector<int> features;
    for (std::size_t i = 0; i < family.features.size(); ++i)
        if (family.features[i].role == Role::quality) features.push_back(static_cast<int>(i));
    return features;
}

Key most_accurate(const Family& family, Key key) {
    for (const int feature : quality_features(family))
        key[static_cast<std::size_t>(feature)] =
            most_accurate_value(family.features[static_cast<std::size_t>(feature)]);
    return canonical(family, std::move(key), kDialect);
}

Key effects_of(const Family& family, Key key) {
    return with_quality_of(family, std::move(key), default_key(family));
}

std::string quality_text(const Family& family, const Key& key) {
    const Key reference = most_accurate(family, key);
    std::string text;
    for (const int feature : quality_features(family)) {
        const auto i = static_cast<std::size_t>(feature);
        if (key[i] == reference[i]) continue;
        if (!text.empty()) text += ' ';
        text += family.features[i].name + '=' + family.features[i].values[static_cast<std::size_t>(key[i])];
    }
    return text;
}

std::vector<Choice> single_choices(const Family& family, const Key& effects) {
    const Key reference = most_accurate(family, effects);
    std::set<Key> seen = {reference};
    std::vector<Choice> choices;
    for (const int feature : quality_features(family)) {
        for (int value = 0; value < value_count(family, feature); ++value) {
            Key key = with(family, reference, feature, value);
            // A rule may have taken the value back: it cannot matter here.
            if (key[static_cast<std::size_t>(feature)] != value || !is_valid(family, key)) continue;
            if (seen.insert(key).second) choices.push_back({std::move(key), feature, value});
        }
    }
    return choices;
}

std::vector<Key> all_qualities(const Family& family, const Key& effects, std::size_t most) {
    std::set<Key> keys = {most_accurate(family, effects)};
    for (const int feature : quality_features(family)) {
        std::set<Key> more;
        for (const Key& key : keys)
            for (int value = 0; value < value_count(family, feature); ++value)
                if (!is_retired(family.features[static_cast<std::size_t>(feature)], value))
                    more.insert(with(family, key, feature, value));
        keys = std::move(more);
        if (keys.size() > most) return {};
    }
    std::erase_if(keys, [&](const Key& key) { return !is_valid(family, key); });
    return {keys.begin(), keys.end()};
}

Key with_quality_of(const Family& family, Key key, const Key& quality) {
    for (const int feature : quality_features(family))
        key[static_cast<std::size_t>(feature)] = quality[static_cast<std::size_t>(feature)];
    return canonical(family, std::move(key), kDialect);
}

bool is_valid(const Family& family, const Key& key) {
    return forbidding_rule(family, key, kDialect) == nullptr;
}

}  // namespace gobo
