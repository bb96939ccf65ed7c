// The section [domain]: what inputs, uniforms and outputs may hold.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "family/family.hpp"
#include "family/toml_reader.hpp"

namespace gobo {

/// Of a family file; sorted by name, as TOML tables are.
[[nodiscard]] std::vector<Domain> read_domains(TomlReader& reader, const toml::table& root);

/// A file of nothing but that section, written as in a family file.
[[nodiscard]] Result<std::vector<Domain>> read_domain_file(std::string_view text, const std::string& path);

}  // namespace gobo
