// A device's handles and the functions of Vulkan that are called: for the files that draw.
#pragma once

#include <array>
#include <mutex>
#include <string>
#include <vector>

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

#include "lab/vulkan/device.hpp"

namespace gobo::vulkan {

/// An error that names a function of Vulkan and what it answered.
[[nodiscard]] tl::unexpected<Diagnostics> fail_call(const char* function, VkResult result);

/// Calls a function of `vk` that may fail, within a function of a Result.
#define GOBO_VULKAN_CALL(function, ...)                                                       \
    if (const VkResult vulkan_result = vk.function(__VA_ARGS__); vulkan_result != VK_SUCCESS) \
    return ::gobo::vulkan::fail_call(#function, vulkan_result)

#define GOBO_VULKAN_INSTANCE_FUNCTIONS(DO)  \
    DO(vkDestroyInstance)                   \
    DO(vkEnumeratePhysicalDevices)          \
    DO(vkGetPhysicalDeviceProperties2)      \
    DO(vkGetPhysicalDeviceFeatures)         \
    DO(vkGetPhysicalDeviceMemoryProperties) \
    DO(vkGetPhysicalDeviceQueueFamilyProperties) DO(vkCreateDevice) DO(vkGetDeviceProcAddr)

#define GOBO_VULKAN_DEVICE_FUNCTIONS(DO)                                                                     \
    DO(vkDestroyDevice)                                                                                      \
    DO(vkGetDeviceQueue)                                                                                     \
    DO(vkCreateCommandPool)                                                                                  \
    DO(vkDestroyCommandPool)                                                                                 \
    DO(vkAllocateCommandBuffers)                                                                             \
    DO(vkFreeCommandBuffers)                                                                                 \
    DO(vkBeginCommandBuffer) DO(vkEndCommandBuffer) DO(vkQueueSubmit) DO(vkQueueWaitIdle) DO(vkCreateBuffer) \
        DO(vkDestroyBuffer) DO(vkGetBufferMemoryRequirements) DO(vkBindBufferMemory) DO(vkCreateImage) DO(   \
            vkDestroyImage) DO(vkGetImageMemoryRequirements) DO(vkBindImageMemory) DO(vkAllocateMemory)      \
            DO(vkFreeMemory) DO(vkMapMemory) DO(vkUnmapMemory) DO(vkCreateImageView) DO(vkDestroyImageView)  \
                DO(vkCreateSampler) DO(vkDestroySampler) DO(vkCreateShaderModule) DO(vkDestroyShaderModule)  \
                    DO(vkCreateDescriptorSetLayout) DO(vkDestroyDescriptorSetLayout) DO(                     \
                        vkCreatePipelineLayout) DO(vkDestroyPipelineLayout) DO(vkCreateDescriptorPool)       \
                        DO(vkDestroyDescriptorPool) DO(vkAllocateDescriptorSets) DO(vkUpdateDescriptorSets)  \
                            DO(vkCreateRenderPass) DO(vkDestroyRenderPass) DO(vkCreateFramebuffer)           \
                                DO(vkDestroyFramebuffer) DO(vkCreateGraphicsPipelines) DO(vkDestroyPipeline) \
                                    DO(vkCmdBeginRenderPass) DO(vkCmdEndRenderPass) DO(vkCmdBindPipeline)    \
                                        DO(vkCmdBindDescriptorSets) DO(vkCmdBindVertexBuffers)               \
                                            DO(vkCmdBindIndexBuffer) DO(vkCmdDrawIndexed)                    \
                                                DO(vkCmdPushConstants) DO(vkCmdPipelineBarrier)              \
                                                    DO(vkCmdCopyBufferToImage) DO(vkCmdCopyImageToBuffer)

#define GOBO_VULKAN_DECLARE(function) PFN_##function function = nullptr;
struct Functions {
    PFN_vkCreateInstance vkCreateInstance = nullptr;
    GOBO_VULKAN_INSTANCE_FUNCTIONS(GOBO_VULKAN_DECLARE)
    GOBO_VULKAN_DEVICE_FUNCTIONS(GOBO_VULKAN_DECLARE)
    PFN_vkDestroyDebugUtilsMessengerEXT vkDestroyDebugUtilsMessengerEXT = nullptr;
};
#undef GOBO_VULKAN_DECLARE

/// A struct of Vulkan's with its type, all else 0.
template <class Struct>
[[nodiscard]] Struct made(VkStructureType type, void* next = nullptr) {
    Struct value{};
    value.sType = type;
    value.pNext = next;
    return value;
}

template <class List>
[[nodiscard]] std::uint32_t size_of(const List& list) {
    return static_cast<std::uint32_t>(list.size());
}

struct Device::State {
    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();

    /// The first kind of memory among `kinds` that has those properties; an error where there is none.
    [[nodiscard]] Result<std::uint32_t> memory_kind(std::uint32_t kinds,
                                                    VkMemoryPropertyFlags properties) const;

    Functions vk;
    VkInstance instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool commands = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties memory{};
    VkPhysicalDeviceLimits limits{};
    std::string name;
    mutable std::mutex mutex;  ///< of what follows: layers call from any thread
    mutable std::vector<std::string> messages;
};

}  // namespace gobo::vulkan
