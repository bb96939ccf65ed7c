// Buffers, images and the other objects of one picture, destroyed together.
#pragma once

#include <functional>
#include <map>

#include "lab/vulkan/picture.hpp"
#include "lab/vulkan/state.hpp"

namespace gobo::vulkan {

struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    void* data = nullptr;  ///< mapped
};

struct DeviceImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

/// What an image is made as.
struct ImageShape {
    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    VkImageUsageFlags usage = 0;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    TextureTexels::Shape shape = TextureTexels::Shape::flat;
    std::uint32_t width = 1;
    std::uint32_t height = 1;
    std::uint32_t layers = 1;
    std::uint32_t levels = 1;
};

class Resources {
  public:
    explicit Resources(const Device& device) : device_(device) {}
    Resources(const Resources&) = delete;
    Resources& operator=(const Resources&) = delete;
    ~Resources();

    [[nodiscard]] const Device::State& state() const { return device_.state(); }
    /// Has something destroyed with the rest, behind what was made later.
    void keep(std::function<void()> destroy) { kept_.push_back(std::move(destroy)); }
    /// A handle of the device's, made by vkCreate...; destroyed by the function of that name.
    template <class Handle, class Info, class Create, class Destroy>
    Result<Handle> make(const char* name, Create create, Destroy destroy, const Info& info) {
        Handle handle = VK_NULL_HANDLE;
        const Device::State& state = device_.state();
        if (const VkResult result = create(state.device, &info, nullptr, &handle); result != VK_SUCCESS)
            return fail_call(name, result);
        keep([&state, destroy, handle] { destroy(state.device, handle, nullptr); });
        return handle;
    }

    /// A buffer that the processor writes and reads.
    [[nodiscard]] Result<Buffer> make_buffer(VkBufferUsageFlags usage, const void* data, std::size_t size);
    [[nodiscard]] Result<DeviceImage> make_image(const ImageShape& shape);
    /// An image that shaders read, with its texels; made once.
    [[nodiscard]] Result<DeviceImage> texture_of(const Texels& texels);

    /// Records commands, has them done and waits for that.
    [[nodiscard]] Result<void> run(const std::function<void(VkCommandBuffer)>& record) const;

  private:
    [[nodiscard]] Result<DeviceImage> make_texture(const TextureTexels& texels);
    Result<void> give_memory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties,
                             VkDeviceMemory& memory);

    Device device_;
    std::vector<std::function<void()>> kept_;
    std::map<Texels, DeviceImage> textures_;
};

/// Makes all of an image ready for another use, once what came before is done.
void change_layout(const Functions& vk, VkCommandBuffer commands, VkImage image, const ImageShape& shape,
                   VkImageLayout from, VkImageLayout to);

}  // namespace gobo::vulkan
