// Subroutines of GLSL 4.00 as plain functions: a family chooses the one that is called by a feature.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace gobo {

/// `subroutine uniform TYPE NAME;` and the functions of that type.
struct SubroutineUniform {
    std::string name;
    std::vector<std::string> functions;
};

/// The subroutine uniforms of code without comments.
[[nodiscard]] std::vector<SubroutineUniform> subroutine_uniforms(const std::string& code);

/// The line of the first subroutine uniform that is an array and whose name `chosen` holds; 0: there is none.
[[nodiscard]] int line_of_subroutine_array(const std::string& code, const std::set<std::string>& chosen);

/// Where `chosen` holds the name of every subroutine uniform in `code`: blanks their declarations, and
/// `subroutine` before types and functions, in both texts, which have the same characters at the same places
/// but for comments.
void choose_subroutines(std::string& text, std::string& code, const std::set<std::string>& chosen);

}  // namespace gobo
