// GLSL's names for SPIR-V types, and how much of a block or of the location space they take.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reflect/spirv_module.hpp"

namespace gobo {

/// GLSL's name of a type that is no array: "float", "ivec3", "mat2x3", "sampler2DArrayShadow",
/// "uimageBuffer", or the struct's name.
[[nodiscard]] std::string glsl_name(const spirv::Module& module, spirv::Id type);

/// The extents of an array, outermost first; empty where the type is no array. 0 stands for no size.
[[nodiscard]] std::vector<int> array_extents(const spirv::Module& module, spirv::Id type);

/// The type with all array dimensions taken off.
[[nodiscard]] spirv::Id array_element(const spirv::Module& module, spirv::Id type);

[[nodiscard]] bool is_array(const spirv::Type& type);
/// A sampler, image or texture.
[[nodiscard]] bool is_opaque(const spirv::Type& type);

/// Every member, array and matrix of the struct states its offset and strides.
[[nodiscard]] bool is_laid_out(const spirv::Module& module, spirv::Id structure);

/// Bytes from the start of a block to the end of its last member, rounded up to 16: what Mesa reports as
/// UNIFORM_BLOCK_DATA_SIZE. An array without a size counts as empty.
[[nodiscard]] std::int64_t block_size(const spirv::Module& module, spirv::Id structure);

/// How many locations a value takes between stages (GLSL 4.50, 4.4.1). A vertex attribute of three or four
/// doubles takes one, elsewhere two.
[[nodiscard]] int location_count(const spirv::Module& module, spirv::Id type, bool vertex_attribute);

}  // namespace gobo
