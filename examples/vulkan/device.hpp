// A Vulkan 1.3 device without a window, and what is needed of one to draw a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

namespace spheres {

inline void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string(what) + " fails: " + std::to_string(result));
}

struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* data = nullptr;  ///< mapped
};

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

/// Everything made through it is destroyed with it. Throws std::runtime_error.
class Device {
  public:
    Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device();

    VkDevice handle() const { return device_; }
    const std::string& name() const { return name_; }
    /// Has `destroy` called when the device goes, before what was made earlier goes.
    void keep(std::function<void()> destroy) { kept_.push_back(std::move(destroy)); }

    Buffer make_buffer(VkBufferUsageFlags usage, const void* data, std::size_t size);
    Image make_image(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect, VkExtent2D size);
    /// Records commands, has them done and waits for that.
    void run(const std::function<void(VkCommandBuffer)>& record);

  private:
    std::uint32_t memory_type(std::uint32_t types, VkMemoryPropertyFlags properties) const;

    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice gpu_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::string name_;
    std::vector<std::function<void()>> kept_;
};

/// Makes all of an image ready for another use, once what came before is done.
void change_layout(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, VkImageLayout from,
                   VkImageLayout to);

}  // namespace spheres
