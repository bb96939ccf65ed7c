// Locations of vertex inputs in Vulkan.
#pragma once

#include "spirv/glsl_type.hpp"

namespace gobo {

/// Locations that a column of a vertex input takes in Vulkan: a column of three or four doubles two, where
/// OpenGL counts one.
[[nodiscard]] inline int vulkan_locations_of_column(const GlslType& type) {
    constexpr int kLocation = 16;  // bytes
    return type.column_size() > kLocation ? 2 : 1;
}

}  // namespace gobo
