// Keys of a generated header as text: for messages, logs and the KEYS of a build.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <type_traits>

namespace gobo::runtime {

enum class FeatureKind : std::uint8_t { choice, count, define };

/// A feature of a family. The names of its values stand in Tables::value_names from `first_name` on; a count
/// has none, its values are numbers from `lowest` on.
struct Feature {
    std::string_view name;
    FeatureKind kind = FeatureKind::choice;
    int value_count = 0;
    int first_name = 0;
    int lowest = 0;
};

/// A key as value numbers, in the order of Tables::features.
template <class Tables>
using Values = std::array<int, Tables::features.size()>;

/// The text of a feature's value; of a value that the feature does not have, its number.
template <class Tables>
[[nodiscard]] std::string value_text(const Feature& feature, int value) {
    const bool named = feature.kind != FeatureKind::count && value >= 0 && value < feature.value_count;
    if (!named) return std::to_string(feature.lowest + value);
    return std::string(
        Tables::value_names[static_cast<std::size_t>(feature.first_name) + static_cast<std::size_t>(value)]);
}

/// "fog=linear point=3": sorted by feature, defaults left out; "default" where all are.
template <class Tables>
[[nodiscard]] std::string key_text(const Values<Tables>& values) {
    std::string text;
    for (std::size_t index = 0; index < values.size(); ++index) {
        if (values[index] == 0) continue;
        if (!text.empty()) text += ' ';
        text += Tables::features[index].name;
        text += '=';
        text += value_text<Tables>(Tables::features[index], values[index]);
    }
    return text.empty() ? "default" : text;
}

/// The names of the features in which two keys differ, with ", " between them.
template <class Tables>
[[nodiscard]] std::string differing_features(const Values<Tables>& left, const Values<Tables>& right) {
    std::string text;
    for (std::size_t index = 0; index < left.size(); ++index) {
        if (left[index] == right[index]) continue;
        if (!text.empty()) text += ", ";
        text += Tables::features[index].name;
    }
    return text;
}

/// How far two keys are apart: first the number of features that differ, then by how much their counts do.
template <class Tables>
[[nodiscard]] std::uint64_t distance(const Values<Tables>& left, const Values<Tables>& right) {
    std::uint64_t features = 0;
    std::uint64_t counts = 0;
    for (std::size_t index = 0; index < left.size(); ++index) {
        if (left[index] == right[index]) continue;
        ++features;
        if (Tables::features[index].kind != FeatureKind::count) continue;
        counts += static_cast<std::uint64_t>(std::abs(left[index] - right[index]));
    }
    return (features << 32U) + counts;
}

/// How much greater the counts of `key` are than those of `wanted`, all together; -1 where one is less or
/// another feature differs.
template <class Tables>
[[nodiscard]] constexpr int counts_beyond(const Values<Tables>& wanted, const Values<Tables>& key) {
    int beyond = 0;
    for (std::size_t index = 0; index < wanted.size(); ++index) {
        const int more = key[index] - wanted[index];
        if (more < 0 || (more > 0 && Tables::features[index].kind != FeatureKind::count)) return -1;
        beyond += more;
    }
    return beyond;
}

/// The value of a feature whose member of a key is a `Member`, from an application's own: counts from whole
/// numbers, flags from what converts to bool, choices from their enum alone.
template <class Member, class Own>
[[nodiscard]] constexpr Member value_from(const Own& own) {
    if constexpr (std::is_enum_v<Member>) {
        static_assert(std::is_same_v<Member, Own>, "a choice is taken from the generated header's own enum");
        return own;
    } else {
        static_assert(std::is_convertible_v<Own, Member>,
                      "a count is taken from a number, a flag from a bool");
        return static_cast<Member>(own);
    }
}

/// Which feature of a key holds a value that the family does not have; empty where none does.
template <class Tables>
[[nodiscard]] std::string describe_out_of_range(const Values<Tables>& values) {
    for (std::size_t index = 0; index < values.size(); ++index) {
        const Feature& feature = Tables::features[index];
        if (values[index] >= 0 && values[index] < feature.value_count) continue;
        const int least = feature.lowest;
        return std::string(feature.name) + "=" + std::to_string(least + values[index]) +
               " is out of range: " + std::to_string(least) + " to " +
               std::to_string(least + feature.value_count - 1);
    }
    return {};
}

/// Why a canonical key within range that was not built is missing, the nearest built key (fewest differing
/// features, then nearest counts, then first in order), and what to add to the build. `values_at(i)` gives
/// the values of the built key number i, for i below `built`.
template <class Tables, class ValuesAt>
[[nodiscard]] std::string describe_not_built(const Values<Tables>& wanted, std::size_t built,
                                             ValuesAt values_at) {
    const std::string key = key_text<Tables>(wanted);
    std::string text = key + " was not built";
    Values<Tables> nearest{};
    std::uint64_t least = ~std::uint64_t{0};
    for (std::size_t index = 0; index < built; ++index) {
        const Values<Tables> values = values_at(index);
        const std::uint64_t apart = distance<Tables>(values, wanted);
        if (apart >= least) continue;
        least = apart;
        nearest = values;
    }
    if (built > 0) {
        text += "; the nearest that was: " + key_text<Tables>(nearest) + " (differs in " +
                differing_features<Tables>(nearest, wanted) + ")";
    }
    return text + "; to build it, add KEYS \"" + key + "\"";
}

}  // namespace gobo::runtime
