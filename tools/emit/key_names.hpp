// The features of a family as C++: names, places in the packed key, and the family's conditions.
#pragma once

#include <string>
#include <vector>

#include "emit/identifiers.hpp"
#include "family/family.hpp"

namespace gobo {

/// A feature in the generated header.
struct CppFeature {
    std::string member;                    ///< of Key
    std::string type;                      ///< of the member: an enum, `int`, or `bool`
    std::vector<std::string> enumerators;  ///< of a choice, in the order of its values
    int word = 0;                          ///< where it stands in the packed key: the word,
    int shift = 0;                         ///< the bits below it there,
    int bits = 0;                          ///< and its own; 0 where there is but one value
};

/// The features of a family in the generated header.
struct CppKey {
    std::vector<CppFeature> features;  ///< in the order of Family::features
    int words = 1;                     ///< 64-bit words of a packed key
};

/// Names and packs the features. The enums' names are claimed in `scope`, that of the header's namespace.
[[nodiscard]] CppKey name_key(const Family& family, CppScope& scope);

/// The C++ of `value` of a feature: `Fog::linear`, `3`, `true`.
[[nodiscard]] std::string cpp_value(const CppFeature& feature, FeatureKind kind, int value);

/// The C++ of a condition over a key named `key`.
[[nodiscard]] std::string cpp_condition(const Expression& condition, const Family& family, const CppKey& key);

}  // namespace gobo
