// Keys made ready to be evaluated and drawn.
#pragma once

#include <map>

#include "compose/search_path.hpp"
#include "lab/study/scene_points.hpp"

namespace gobo::study {

/// The permutations of some keys, with what they are made of.
struct Variants {
    Composition composition;
    std::vector<Variant> all;  ///< in the order of the keys
    std::map<Key, std::size_t> index;

    [[nodiscard]] const Variant& at(const Key& key) const { return all[index.at(key)]; }
};

/// Composes, validates and decodes; each key once. Errors of any of them.
[[nodiscard]] Result<Variants> load_variants(const Family& family, const SearchPath& search,
                                             std::vector<Key> keys, int jobs);

}  // namespace gobo::study
