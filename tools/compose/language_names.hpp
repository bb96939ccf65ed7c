// Which version of GLSL, or which extension, brought a name that glslang knows earlier.
#pragma once

#include <string_view>

#include "compose/dialect.hpp"

namespace gobo {

/// A name that no version has: an extension alone brings it.
inline constexpr int kNever = 100'000;
/// No OpenGL has it: it is Vulkan's.
inline constexpr int kVulkan = 200'000;

/// The first versions that have a name, and the extensions by which earlier ones do.
struct NameSince {
    std::string_view name;  ///< ending in `*`: what begins so
    int desktop;
    int es;
    std::string_view extensions;  ///< with blanks between; one that begins with `_` ends so
};

/// The entry of an identifier, or of the name of a layout qualifier; null for what every version has.
[[nodiscard]] const NameSince* name_since(std::string_view identifier);
[[nodiscard]] const NameSince* layout_since(std::string_view qualifier);

/// Whose an extension is.
enum class ExtensionOf { any, desktop, es, vulkan, tools };
[[nodiscard]] ExtensionOf owner_of_extension(std::string_view name);

/// Whether glslang defines a macro and no driver of OpenGL does: `GL_SPIRV`, and those of extensions that
/// Vulkan or tools alone have.
[[nodiscard]] bool is_foreign_macro(std::string_view name);

/// Whether no version of OpenGL has in its core what the extension brings, so that drivers may lack it.
[[nodiscard]] bool may_be_lacking(std::string_view extension);

}  // namespace gobo
