// The parts of a generated header that depend on the family alone: enums, Key, rules and packing.
#pragma once

#include <vector>

#include "emit/header_templates.hpp"
#include "emit/key_names.hpp"
#include "family/family.hpp"

namespace gobo {

/// Adds the values of the templates' placeholders about keys. `rules` are those of the dialect.
void describe_key(const Family& family, const std::vector<Rule>& rules, const CppKey& key,
                  TemplateValues& values);

}  // namespace gobo
