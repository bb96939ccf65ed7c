// The tables of a family file that state conditions on keys: [[rules]], [[relations]]. What a condition is
// made of, see expression.hpp.
#pragma once

#include <string_view>
#include <vector>

#include "family/family.hpp"
#include "family/toml_reader.hpp"

namespace gobo {

// Errors go to the reader.

/// Rules and relations in the order of the file, their conditions parsed; before them the rules by which a
/// program has only the features that it names.
[[nodiscard]] std::vector<Rule> read_rules(const TomlTable& root, const std::vector<Feature>& features);
[[nodiscard]] std::vector<Relation> read_relations(const TomlTable& root,
                                                   const std::vector<Feature>& features);

/// The condition in an entry of a table, which has it.
Expression read_condition(const TomlTable& table, std::string_view entry,
                          const std::vector<Feature>& features);

}  // namespace gobo
