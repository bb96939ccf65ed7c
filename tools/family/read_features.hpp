// The [features] and [[rules]] of a family file.
#pragma once

#include <vector>

#include "family/family.hpp"
#include "family/toml_reader.hpp"

namespace gobo {

/// The features, sorted by name. Errors go to the reader.
[[nodiscard]] std::vector<Feature> read_features(TomlReader& reader, const toml::table& root);

/// The rules in the order of the file, their conditions parsed. Errors go to the reader.
[[nodiscard]] std::vector<Rule> read_rules(TomlReader& reader, const toml::table& root,
                                           const std::vector<Feature>& features);

/// The condition that `table` holds under `name`, which must be there. Errors go to the reader.
[[nodiscard]] Expression read_condition(TomlReader& reader, const toml::table& table, std::string_view name,
                                        const std::vector<Feature>& features);

}  // namespace gobo
