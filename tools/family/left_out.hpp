// What a family leaves out of the one that it extends: `without = ["toon", "shading=vertex", "Material"]`.
#pragma once

#include <string>
#include <vector>

#include "family/family.hpp"
#include "family/toml_reader.hpp"

namespace gobo {

/// Takes the features named, alone or with the value that stands for them, varyings, and what [domain] and
/// [render] say of the named blocks and inputs out of the document of a family. Returns the names that are
/// nothing of it. Where any is given its rules go too, since rules_without() has them.
[[nodiscard]] std::vector<std::string> leave_out(toml::table& base, const std::vector<std::string>& names);

/// What a family has of the conditions of the one that it extends.
struct Inherited {
    std::vector<Rule> rules;
    std::vector<Relation> relations;
};

/// The rules and relations of the document `base`, in which the features named stand at their default or at
/// the value named with them, for a family that has all others of its features; without the relations of what
/// is left out. Errors of `base` are those of its reader.
[[nodiscard]] Inherited inherited_without(const TomlTable& base, const std::vector<std::string>& names,
                                          const std::vector<Feature>& features);

}  // namespace gobo
