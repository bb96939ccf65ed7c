// The [[relations]] of a family file.
#pragma once

#include <vector>

#include "family/family.hpp"
#include "family/toml_reader.hpp"

namespace gobo {

/// The relations in the order of the file, their conditions parsed. Errors go to the reader.
[[nodiscard]] std::vector<Relation> read_relations(TomlReader& reader, const toml::table& root,
                                                   const std::vector<Feature>& features);

}  // namespace gobo
