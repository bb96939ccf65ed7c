// Names of a family and of GLSL as C++ identifiers.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace gobo {

/// A C++ identifier as near to `name` as can be: other characters become '_', runs of '_' and leading ones
/// are dropped (C++ reserves them), a leading digit gets a '_' before it (`4x` is `_4x`), and a keyword of
/// C++ (20 too, or a macro that common platforms define) gets one behind it (`default` is `default_`).
[[nodiscard]] std::string cpp_identifier(std::string_view name);

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
