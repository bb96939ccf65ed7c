// What Vulkan binds a sampler, image or acceleration structure as.
#pragma once

#include <string_view>

namespace gobo {

/// The enumerator of gobo::DescriptorKind for what the interface lists as a sampler, by its GLSL type.
[[nodiscard]] std::string_view descriptor_kind(std::string_view type);

}  // namespace gobo
