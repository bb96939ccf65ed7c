// What is drawn to: an image of colours and one of depths, or depths alone.
#pragma once

#include "lab/vulkan/resources.hpp"

namespace gobo::vulkan {

struct Target {
    ImageShape color_shape;
    ImageShape depth_shape;
    DeviceImage color;
    DeviceImage depth;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    VkExtent2D extent{};
    bool has_color = true;
};

/// Fault::usage where the device has no framebuffers of that size.
[[nodiscard]] Result<Target> make_target(Resources& resources, int width, int height, bool has_color);

}  // namespace gobo::vulkan
