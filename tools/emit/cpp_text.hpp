// Pieces of C++ text that every section of a generated header needs: literals, lists and identifiers.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gobo {

/// `text` as a C++ string literal, whatever its bytes: a raw one where it holds a line end and nothing but
/// printable ASCII, tabs and line ends, otherwise one with escapes.
[[nodiscard]] std::string cpp_literal(std::string_view text);

/// `text` for a `//` comment, whatever its bytes: `_` for line ends, for what joins lines, and for all that
/// is not printable ASCII.
[[nodiscard]] std::string cpp_comment(std::string_view text);

/// The items within braces, some to a line; nothing where there are none (std::array of 0 takes no inner
/// braces).
[[nodiscard]] std::string cpp_list(const std::vector<std::string>& items);

/// `text` cut into parts whose literals stay below the 16,380 bytes that all compilers take, at line ends
/// where possible. At least one part.
[[nodiscard]] std::vector<std::string_view> cut_for_literals(std::string_view text);

/// A C++ identifier as near to `name` as can be: other characters become '_', runs of '_' and leading ones
/// are dropped (C++ reserves them), a leading digit gets a '_' before it (`4x` is `_4x`), and a keyword of
/// C++ (20 too) or a macro of the standard library, <windows.h> or X11 gets one behind it (`default` is
/// `default_`, `near` `near_`, `INT_MAX` `INT_MAX_`).
[[nodiscard]] std::string cpp_identifier(std::string_view name);

/// The same for what '(' follows: `min` and `max` are macros of <windows.h> there.
[[nodiscard]] std::string cpp_function_name(std::string_view name);

/// `fog_distance` as the name of a type: `FogDistance`.
[[nodiscard]] std::string cpp_type_name(std::string_view name);

/// Whether `name` can be written as it is in C++.
[[nodiscard]] bool is_cpp_identifier(std::string_view name);

/// The names of one C++ scope: hands out each only once.
class CppScope {
  public:
    CppScope() = default;
    explicit CppScope(std::set<std::string, std::less<>> taken) : taken_(std::move(taken)) {}

    /// `identifier` if it is free, else with `suffix` behind it, else with `suffix` and 2, 3, ...
    std::string claim(const std::string& identifier, std::string_view suffix = "_");

  private:
    std::set<std::string, std::less<>> taken_;
};

}  // namespace gobo
