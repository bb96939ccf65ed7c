#include "lab/study/qualities.hpp"

#include <algorithm>
#include <set>

#include "compose/dialect.hpp"
#include "family/key.hpp"

namespace gobo::study {
namespace {

Key with(const Family& family, Key key, int feature, int value) {
    key[feature] = value;
    return canonical(family, std::move(key), kStudiedDialect);
}

}  // namespace

int most_accurate_value(const Feature& feature) {
    return feature.default_place > 0 ? 1 : 0;  // the default stands first, the others behind it as listed
}

std::vector<int> quality_features(const Family& family) {
    std::vector<int> features;
    for (int i = 0; i < std::ssize(family.features); ++i)
        if (family.features[i].role == Role::quality) features.push_back(i);
    return features;
}

Key most_accurate(const Family& family, Key key) {
    for (const int feature : quality_features(family))
        key[feature] = most_accurate_value(family.features[feature]);
    return canonical(family, std::move(key), kStudiedDialect);
}

std::string quality_text(const Family& family, const Key& key) {
    const Key reference = most_accurate(family, key);
    std::string text;
    for (const int i : quality_features(family))
        if (key[i] != reference[i])
            text +=
                (text.empty() ? "" : " ") + family.features[i].name + '=' + family.features[i].values[key[i]];
    return text;
}

std::vector<Choice> single_choices(const Family& family, const Key& effects) {
    const Key reference = most_accurate(family, effects);
    std::set<Key> seen = {reference};
    std::vector<Choice> choices;
    for (const int feature : quality_features(family)) {
        for (int value = 0; value < std::ssize(family.features[feature].values); ++value) {
            Key key = with(family, reference, feature, value);
            // A rule may have taken the value back: it cannot matter here.
            if (key[feature] == value && is_valid(family, key) && seen.insert(key).second)
                choices.push_back({std::move(key), feature, value});
        }
    }
    return choices;
}

std::vector<Key> choices_of_es300(const Family& family, const Key& effects) {
    std::vector<Key> keys;
    for (const int feature : quality_features(family)) {
        for (int value = 1; value < std::ssize(family.features[feature].values); ++value) {
            const Key key = with(family, effects, feature, value);
            if (key[feature] == value && !is_valid(family, key) &&
                forbidding_rule(family, key, name_of(Dialect::es300)) == nullptr)
                keys.push_back(key);
        }
    }
    return keys;
}

std::vector<Key> all_qualities(const Family& family, const Key& effects, std::size_t most) {
    std::set<Key> keys = {most_accurate(family, effects)};
    for (const int feature : quality_features(family)) {
        const std::vector<std::string>& values = family.features[feature].values;
        const std::vector<std::string>& excluded = family.features[feature].excluded;
        std::set<Key> more;
        for (const Key& key : keys)
            for (int value = 0; value < std::ssize(values); ++value)
                // The most accurate one is what the others are compared with, excluded or not.
                if (value == most_accurate_value(family.features[feature]) ||
                    std::find(excluded.begin(), excluded.end(), values[value]) == excluded.end())
                    more.insert(with(family, key, feature, value));
        keys = std::move(more);
        if (keys.size() > most) return {};
    }
    std::erase_if(keys, [&](const Key& key) { return !is_valid(family, key); });
    return {keys.begin(), keys.end()};
}

Key with_quality_of(const Family& family, Key key, const Key& quality) {
    for (const int feature : quality_features(family)) key[feature] = quality[feature];
    return canonical(family, std::move(key), kStudiedDialect);
}

bool is_valid(const Family& family, const Key& key) {
    return forbidding_rule(family, key, kStudiedDialect) == nullptr;
}

}  // namespace gobo::study
