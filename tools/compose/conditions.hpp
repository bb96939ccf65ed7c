// The preprocessor's conditions: which of a stage's lines may be compiled.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compose/scan_piece.hpp"

namespace gobo {

/// A value that is unknown where only the driver knows it: whether it has an extension's macro.
using Known = std::optional<std::int64_t>;

/// A `#define`.
struct MacroDefinition {
    bool is_function = false;
    bool is_certain = true;  ///< false where what only the driver knows decides on it
    std::vector<std::string> parameters;
    std::vector<std::string> body;
};

/// The name that what stands behind #define begins with.
[[nodiscard]] std::string_view macro_name(std::string_view text);

/// Follows a stage's directives in order. What cannot be known is taken to hold, and its opposite too: the
/// text goes on to the driver with all its conditions.
class Conditions {
  public:
    /// The macros that a prologue defines, and those that GLSL has by its version. What a driver of OpenGL
    /// compiles has none of is_foreign_macro().
    explicit Conditions(std::string_view prologue, bool is_for_driver = true);

    /// Takes in a condition, #define or #undef. Error: macros that expand without end.
    [[nodiscard]] Result<void> apply(const Directive& directive);

    /// Whether what follows may be compiled.
    [[nodiscard]] bool is_active() const { return frames_.empty() || frames_.back().is_active; }
    /// Whether that is sure, whatever the driver has.
    [[nodiscard]] bool is_certain() const { return frames_.empty() || frames_.back().is_certain; }
    /// 1 or 0; unknown where only the driver knows.
    [[nodiscard]] Known is_defined(std::string_view name) const;
    /// What a condition would hold, or another whole number; nothing where that is unknown.
    /// With `has_variables`, where a name that is no macro may be one of the shader, such a name is unknown
    /// too, not 0.
    [[nodiscard]] Result<Known> value_of(const Directive& directive, bool has_variables = false) const;
    /// Whether `#define NAME TEXT` would give a macro that is defined another text.
    [[nodiscard]] bool would_redefine(const Directive& directive) const;

  private:
    /// An #if that is open.
    struct Frame {
        bool is_reached;  ///< the lines around it are active
        bool is_done;     ///< a branch was surely taken
        bool is_active;
        bool is_certain;
    };

    void define(std::string_view text);
    [[nodiscard]] bool is_drivers(std::string_view name) const;
    [[nodiscard]] MacroDefinition definition(std::string_view text) const;

    std::map<std::string, MacroDefinition, std::less<>> macros_;
    std::vector<Frame> frames_;
    bool is_for_driver_;
};

}  // namespace gobo
