// Small families for the tests, and what they mean by brute force.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/file_system.hpp"
#include "family/family.hpp"
#include "family/key_space.hpp"

namespace gobo {

/// `[features]`, `[[rules]]` and the rest, behind a head that names the templates tiny.vert and tiny.frag.
[[nodiscard]] Family family_of(const std::string& body);

/// The shipped family `lit`, from the source tree.
[[nodiscard]] Family lit_family();

/// Name and body of families that differ in kinds of features and rules.
[[nodiscard]] const std::vector<std::pair<std::string, std::string>>& small_families();

/// All keys of the family's product of values, in lexicographic order.
[[nodiscard]] std::vector<Key> product_of(const Family& family, const std::vector<int>& over = {});

/// The canonical valid keys by trying every one, without the decision diagram.
[[nodiscard]] std::vector<Key> keys_by_trying(const Family& family, std::string_view dialect,
                                              const KeySpaceLimits& limits);

/// The first message as it is printed; empty where there is none.
[[nodiscard]] std::string first_text(const Diagnostics& diagnostics);

}  // namespace gobo
