// Which keys a combination of effects can be drawn with: its qualities.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "budget/budget.hpp"

namespace gobo::study {

/// The index of a quality feature's most accurate value: the first that the family lists.
[[nodiscard]] int most_accurate_value(const Feature& feature);

/// The quality features' indices in the family.
[[nodiscard]] std::vector<int> quality_features(const Family& family);

/// The key with every quality feature at its most accurate value, canonical.
[[nodiscard]] Key most_accurate(const Family& family, Key key);

/// The key's quality features that differ from the most accurate ones of its effects: "power=schlick
/// shading=vertex"; empty for the most accurate key itself.
[[nodiscard]] std::string quality_text(const Family& family, const Key& key);

/// The keys that differ from the most accurate one in one quality feature, and how. Valid, canonical, each
/// once, without the most accurate one itself.
struct Choice {
    Key key;
    int feature = 0;
    int value = 0;
};
[[nodiscard]] std::vector<Choice> single_choices(const Family& family, const Key& effects);

/// The keys that differ from the effects in one quality value that the studied dialect refuses and GLSL
/// ES 3.00 has.
[[nodiscard]] std::vector<Key> choices_of_es300(const Family& family, const Key& effects);

/// Every valid canonical key of the effects, sorted, excluded values left out. More than `most` are not
/// enumerated: then nothing.
[[nodiscard]] std::vector<Key> all_qualities(const Family& family, const Key& effects, std::size_t most);

/// The key with the quality features' values of another one, canonical.
[[nodiscard]] Key with_quality_of(const Family& family, Key key, const Key& quality);

/// Whether the rules allow the key in GLSL's own dialect.
[[nodiscard]] bool is_valid(const Family& family, const Key& key);

}  // namespace gobo::study
