// Subroutines of GLSL 4.00 as plain functions: a family chooses the one that is called by a feature. The
// uniform becomes a function that calls it, so that every other use of either name stays what it is.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gobo {

/// `subroutine uniform TYPE NAME;` and the functions of that type.
struct SubroutineUniform {
    std::string name;
    std::string type;
    std::vector<std::string> functions;
    int line = 0;  ///< on which its declaration ends
};

/// `subroutine RESULT NAME(PARAMETER, PARAMETER);`
struct SubroutineType {
    std::string name;
    std::string result;
    std::vector<std::string> parameters;  ///< named anew: "in vec3 argument_0"
};

/// The subroutine uniforms of code without comments.
[[nodiscard]] std::vector<SubroutineUniform> subroutine_uniforms(const std::string& code);

/// The types of subroutines that such code declares.
[[nodiscard]] std::vector<SubroutineType> subroutine_types(const std::string& code);

/// "vec4 shade(vec3 argument_0)", and with a body that calls the function.
[[nodiscard]] std::string prototype_of(const SubroutineUniform& uniform, const SubroutineType& type);
[[nodiscard]] std::string call_of(const SubroutineUniform& uniform, const SubroutineType& type,
                                  std::string_view function);

/// The line of the first subroutine uniform that is an array and whose name `chosen` holds; 0: there is none.
[[nodiscard]] int line_of_subroutine_array(const std::string& code, const std::set<std::string>& chosen);

/// Where `chosen` holds the name of every subroutine uniform in `code`: blanks their declarations, and
/// `subroutine` before types and functions, in both texts, which have the same characters at the same places
/// but for comments. Whether it does so.
bool choose_subroutines(std::string& text, std::string& code, const std::set<std::string>& chosen);

}  // namespace gobo
