// From the text of a family file to a Family.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "family/family.hpp"

namespace gobo {

/// The text of a family file and its path.
struct FamilyText {
    std::string text;
    std::string path;
};

/// Finds the family that another one extends, by name or path.
using FindFamily = std::function<Result<FamilyText>(const std::string& name)>;

/// Reads a family file (docs/family_file.md describes it). `path` stands in diagnostics and decides the
/// folder of the templates. Anything unknown, missing or of the wrong type is an error with its place.
///
/// `extends = "lit"` lays the file over another family: its features' values and its rules are added behind
/// those of the other, whatever else it states takes the other's place, and `without` names what it has not.
[[nodiscard]] Result<Family> read_family(std::string_view text, const std::string& path,
                                         const FindFamily& find_base = {});

/// A file of nothing but the section [domain], written as in a family file.
[[nodiscard]] Result<std::vector<Domain>> read_domain_file(std::string_view text, const std::string& path);

/// Whether a domain holds nothing that another one of the same name does not.
[[nodiscard]] bool is_within(const Domain& narrower, const Domain& domain);

/// Puts those in the place of the family's own, and the order of two members of a struct beside them. As
/// ranges where they were stated as comparisons with numbers, unit() or not_zero(). Errors, at their places:
/// one of a name that the family declares no domain for, one that holds what the family's does not, and what
/// check(block) cannot check.
[[nodiscard]] Result<std::vector<Domain>> narrow_domains(Family& family, const std::vector<Domain>& narrower);

}  // namespace gobo
