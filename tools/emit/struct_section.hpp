// The part of a generated header that mirrors uniform blocks as C++ structs.
#pragma once

#include <string>
#include <vector>

#include "emit/header_templates.hpp"
#include "emit/identifiers.hpp"
#include "family/family.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// A struct for every block and for every struct within one, inner ones first, each name claimed in `scope`.
/// A layout that no C++ struct can mirror is an error (Fault::input).
[[nodiscard]] Result<std::string> struct_section(const std::vector<Block>& blocks,
                                                 const std::vector<Domain>& domains,
                                                 const TextTemplate& structure, CppScope& scope);

/// The range of an input or uniform as a comment: "[0, 1000], or 0"; empty where the family declares none.
/// Array indices in either name do not matter.
[[nodiscard]] std::string domain_text(const std::vector<Domain>& domains, const std::string& path);

}  // namespace gobo
