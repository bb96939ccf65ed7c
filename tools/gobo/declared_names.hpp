// The names that shaders declare, as the tables of a family file write them, and whether a name is one.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "reflect/interface.hpp"

namespace gobo {

/// What a table takes for a name.
struct NameRules {
    bool elements = false;      ///< "lights[2].color", of one element; "lights[].color" is always taken
    bool whole_arrays = false;  ///< "weights", of an array of numbers
    bool is_array = false;      ///< the name of an array and nothing within it
    bool builtins = false;      ///< "gl_FragDepth"
    bool components = false;    ///< "place.x", of a vector
};

/// The uniforms, members, samplers, inputs and outputs of stages by their whole names, with the extents of
/// arrays: "Lights.lights[4].color"; 0 where any number of elements may be.
class DeclaredNames {
  public:
    /// `counted` is how many elements an array whose size hangs on the key may have.
    explicit DeclaredNames(int counted) : counted_(counted) {}

    void add(const Interface& interface);

    /// Whether one begins as the name does.
    [[nodiscard]] bool has_root(std::string_view name) const;
    /// Whether it begins with a member of a block, which is named behind its block.
    [[nodiscard]] bool begins_with_member(std::string_view name) const;
    /// Whether the name is one, by the table's rules.
    [[nodiscard]] bool has(std::string_view name, const NameRules& rules) const;
    /// What to write instead of a name that is none.
    [[nodiscard]] std::string help_for(std::string_view name, const NameRules& rules) const;

  private:
    void add(const std::string& path, const std::string& type, const std::vector<int>& extents,
             const std::vector<Member>& members);

    int counted_;
    std::vector<std::string> names_;
    std::vector<std::pair<std::string, std::size_t>>
        vectors_;                                 ///< those among the names, and their components
    std::set<std::string, std::less<>> members_;  ///< of blocks without an instance
};

}  // namespace gobo
