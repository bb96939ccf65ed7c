// How glslang is given versions of GLSL of which it makes no SPIR-V, and extensions that it does not know.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "compose/dialect.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

/// Whether glslang makes SPIR-V of the version as it is.
[[nodiscard]] bool makes_spirv(const GlslVersion& version);
/// Whether the version has the texture functions that carry their sampler's type in their name.
[[nodiscard]] bool has_old_functions(const GlslVersion& version);

/// Texts for raised_for_spirv(): the texture functions of before GLSL 1.30, which carried their sampler's
/// type in their name; those of shadows gave four components.
[[nodiscard]] std::string renamed_functions();
/// The same as functions, for shaders that call something else `texture`: they are read before that.
[[nodiscard]] std::string old_functions(StageKind stage);

/// The prologue with its version raised to the lowest one of which glslang makes SPIR-V, or to `raised`, and
/// the old functions behind that where the version has them.
[[nodiscard]] std::string raised_for_spirv(std::string_view prologue, const std::string& functions,
                                           const std::string& raised = {});
/// The shader is right by its own version's rules, so the errors of the raised one need a word.
[[nodiscard]] Diagnostics explained(Diagnostics diagnostics, const GlslVersion& version);

/// Says of each error at what an older version has that no file of the family states one, if so.
[[nodiscard]] Diagnostics with_version_missed(Diagnostics found, const Family& family,
                                              const Composition& composition);

/// The prologue for glslang, which refuses to require extensions that it does not know: of those that drivers
/// have.
[[nodiscard]] std::string without_requirements(std::string prologue);
/// Whether it is such an extension, of every profile.
[[nodiscard]] bool is_unknown_to_glslang(std::string_view extension);

/// The functions of the shader's own, in OpenGL ES 3.00 or below, that glslang takes for built-in ones of
/// later versions or extensions, by its errors. Names that are members of structs too are left out:
/// reflection would show another one.
[[nodiscard]] std::set<std::string> taken_names(const Diagnostics& errors,
                                                const std::vector<const Piece*>& pieces);
/// The prologue with macros that keep the shader's own names apart from glslang's.
[[nodiscard]] std::string with_own_names(std::string prologue, const std::set<std::string>& names);

}  // namespace gobo
