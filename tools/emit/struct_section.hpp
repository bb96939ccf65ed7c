// The part of a generated header that mirrors uniform blocks as C++ structs.
#pragma once

#include <string>
#include <vector>

#include "emit/header_templates.hpp"
#include "emit/identifiers.hpp"
#include "family/family.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// A member as C++ names it, and its members where it is a struct.
struct NamedMember {
    Member member;
    std::string identifier;
    std::vector<NamedMember> members;
};

/// A block's struct as it was written.
struct NamedBlock {
    std::string glsl_name;
    std::string cpp_name;
    std::vector<NamedMember> members;
};

struct StructSection {
    std::string text;
    std::vector<NamedBlock> blocks;
};

/// A struct for every block and for every struct within one, inner ones first, each name claimed in `scope`.
/// A layout that no C++ struct can mirror is an error (Fault::input).
[[nodiscard]] Result<StructSection> struct_section(const std::vector<Block>& blocks,
                                                   const std::vector<Domain>& domains,
                                                   const TextTemplate& structure, CppScope& scope);

/// The domain of an input or uniform; nullptr where the family declares none. Array indices in either name do
/// not matter.
[[nodiscard]] const Domain* domain_of(const std::vector<Domain>& domains, const std::string& path);

/// The range of an input or uniform as a comment: "[0, 1000], or 0"; empty where the family declares none.
/// Array indices in either name do not matter.
[[nodiscard]] std::string domain_text(const std::vector<Domain>& domains, const std::string& path);

}  // namespace gobo
