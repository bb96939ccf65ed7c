// The tables of a family file that are about features: [features], [renamed], [[rules]], [[relations]].
#pragma once

#include <string_view>
#include <vector>

#include "family/family.hpp"
#include "family/toml_reader.hpp"

namespace gobo {

// Errors go to the reader.

/// Sorted by name, with the names of [renamed].
[[nodiscard]] std::vector<Feature> read_features(TomlReader& reader, const toml::table& root);

/// Rules and relations in the order of the file, their conditions parsed.
[[nodiscard]] std::vector<Rule> read_rules(TomlReader& reader, const toml::table& root,
                                           const std::vector<Feature>& features);
[[nodiscard]] std::vector<Relation> read_relations(TomlReader& reader, const toml::table& root,
                                                   const std::vector<Feature>& features);

/// The values of a table such as [render]: each a source's name, a table with source and numbers, or numbers.
[[nodiscard]] std::vector<RenderValue> read_render_values(TomlReader& reader, const toml::table& parent,
                                                          std::string_view name);

/// The condition in the entry `name` of a table, which has it.
Expression read_condition(TomlReader& reader, const toml::table& table, std::string_view name,
                          const std::vector<Feature>& features);

/// The index of a feature that `what` names in the entry at `node`; 0 and an error where there is none.
int read_feature_name(TomlReader& reader, const toml::node& node, std::string_view what,
                      const std::string& name, const std::vector<Feature>& features);

}  // namespace gobo
