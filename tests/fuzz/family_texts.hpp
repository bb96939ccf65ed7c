// Families, their files and some of their keys, from the text of one input.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "family/family.hpp"

namespace gobo::fuzz {

using Files = std::map<std::string, std::string, std::less<>>;

/// Parts of an input between lines "---- NAME", by name. What stands before the first has the name "".
Files parts_of(std::string_view input);

/// A family that has every kind of feature, and two counts to add.
const Family& small_family();

/// At most sixteen.
std::vector<Key> some_keys(const Family& family);

/// The family whose file is the part "family.toml" (as in tests/errors/cases), or else ""; those that it
/// extends are other parts.
Result<Family> family_of(const Files& parts);

}  // namespace gobo::fuzz
