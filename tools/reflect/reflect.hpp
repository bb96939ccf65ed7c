// From SPIR-V to the interface that an application sees.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "reflect/interface.hpp"
#include "spirv/module.hpp"
#include "spirv/usage.hpp"

namespace gobo {

/// Whose rules a module follows: only Vulkan has descriptor sets.
enum class Api { opengl, vulkan };

/// The interface of one stage: the first entry point of the module. Offsets and strides are those that the
/// module's decorations state; names are those of the source. gl_PerVertex and other built-in variables are
/// left out. Members of type `bool` in blocks read "uint" (see restore_bools()). Errors
/// (Fault::internal): a malformed module, none or an unknown kind of entry point, a block without layout;
/// (Fault::input): structs nested too deeply, blocks and variables beyond what any device holds.
[[nodiscard]] Result<Interface> reflect_stage(std::span<const std::uint32_t> words);
[[nodiscard]] Result<Interface> reflect_stage(const spirv::Module& module, const spirv::Usage& usage,
                                              Api api = Api::opengl);

/// What std430 aligns a struct to: the most that any number or column in it needs.
[[nodiscard]] int alignment_of(const std::vector<Member>& members);

/// Bytes of a member of a block, from its strides. A row-major matrix is stored as an array of its rows.
[[nodiscard]] std::int64_t size_of(const Member& member);

/// The variable is one of OpenGL's own: gl_Position, gl_PerVertex, gl_DepthRange.
[[nodiscard]] bool is_built_in(const spirv::Module& module, const spirv::Variable& variable);

/// The name under which OpenGL knows the variable: a block's own rather than its instance's.
[[nodiscard]] std::string interface_name(const spirv::Module& module, const spirv::Variable& variable);

}  // namespace gobo
