#include "lab/vulkan/resources.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace gobo::vulkan {
namespace {

constexpr std::size_t kChannels = 4;

/// The next smaller copy of layers of colours: each texel the average of four, or of two where a side is one
/// texel already.
std::vector<float> halved(const std::vector<float>& values, std::uint32_t width, std::uint32_t height,
                          std::uint32_t layers) {
    const std::uint32_t half_width = std::max(width / 2, 1U);
    const std::uint32_t half_height = std::max(height / 2, 1U);
    std::vector<float> result;
    for (std::uint32_t layer = 0; layer < layers; ++layer)
        for (std::uint32_t y = 0; y < half_height; ++y)
            for (std::uint32_t x = 0; x < half_width; ++x)
                for (std::size_t channel = 0; channel < kChannels; ++channel) {
                    const auto at = [&](std::uint32_t dx, std::uint32_t dy) {
                        const std::uint32_t column = std::min(2 * x + dx, width - 1);
                        const std::uint32_t row = std::min(2 * y + dy, height - 1);
                        return values[((std::size_t{layer} * height + row) * width + column) * kChannels +
                                      channel];
                    };
                    result.push_back((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4);
                }
    return result;
}

VkImageViewType view_type(TextureTexels::Shape shape) {
    switch (shape) {
        case TextureTexels::Shape::array:
            return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
        case TextureTexels::Shape::cube:
            return VK_IMAGE_VIEW_TYPE_CUBE;
        case TextureTexels::Shape::volume:
            return VK_IMAGE_VIEW_TYPE_3D;
        default:
            return VK_IMAGE_VIEW_TYPE_2D;
    }
}

}  // namespace

Resources::~Resources() {
    while (!kept_.empty()) {
        kept_.back()();
        kept_.pop_back();
    }
}

Result<void> Resources::give_memory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties,
                                    VkDeviceMemory& memory) {
    auto info = made<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = needs.size;
    GOBO_TRY(info.memoryTypeIndex, state().memory_kind(needs.memoryTypeBits, properties));
    GOBO_TRY(memory, make<VkDeviceMemory>("vkAllocateMemory", state().vk.vkAllocateMemory,
                                          state().vk.vkFreeMemory, info));
    return {};
}

Result<Buffer> Resources::make_buffer(VkBufferUsageFlags usage, const void* data, std::size_t size) {
    const Functions& vk = state().vk;
    auto info = made<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = std::max<std::size_t>(size, 1);
    info.usage = usage;
    Buffer buffer;
    GOBO_TRY(buffer.buffer, make<VkBuffer>("vkCreateBuffer", vk.vkCreateBuffer, vk.vkDestroyBuffer, info));
    VkMemoryRequirements needs{};
    vk.vkGetBufferMemoryRequirements(state().device, buffer.buffer, &needs);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    GOBO_TRY_DO(give_memory(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                            memory));
    GOBO_VULKAN_CALL(vkBindBufferMemory, state().device, buffer.buffer, memory, 0);
    GOBO_VULKAN_CALL(vkMapMemory, state().device, memory, 0, VK_WHOLE_SIZE, 0, &buffer.data);
    if (data != nullptr && size > 0) std::memcpy(buffer.data, data, size);
    return buffer;
}

Result<DeviceImage> Resources::make_image(const ImageShape& shape) {
    const Functions& vk = state().vk;
    const bool is_volume = shape.shape == TextureTexels::Shape::volume;
    auto info = made<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    if (shape.shape == TextureTexels::Shape::cube) info.flags = VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
    info.imageType = is_volume ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
    info.format = shape.format;
    info.extent = {shape.width, shape.height, is_volume ? shape.layers : 1};
    info.mipLevels = shape.levels;
    info.arrayLayers = is_volume ? 1 : shape.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = shape.usage;
    DeviceImage image;
    GOBO_TRY(image.image, make<VkImage>("vkCreateImage", vk.vkCreateImage, vk.vkDestroyImage, info));
    VkMemoryRequirements needs{};
    vk.vkGetImageMemoryRequirements(state().device, image.image, &needs);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    GOBO_TRY_DO(give_memory(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, memory));
    GOBO_VULKAN_CALL(vkBindImageMemory, state().device, image.image, memory, 0);
    auto view = made<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    view.image = image.image;
    view.viewType = view_type(shape.shape);
    view.format = shape.format;
    view.subresourceRange = {shape.aspect, 0, shape.levels, 0, info.arrayLayers};
    GOBO_TRY(image.view,
             make<VkImageView>("vkCreateImageView", vk.vkCreateImageView, vk.vkDestroyImageView, view));
    return image;
}

Result<DeviceImage> Resources::texture_of(const Texels& texels) {
    const auto [place, is_new] = textures_.try_emplace(texels);
    if (is_new) {
        GOBO_TRY(place->second, make_texture(*texels));
    }
    return place->second;
}

Result<DeviceImage> Resources::make_texture(const TextureTexels& texels) {
    const Functions& vk = state().vk;
    const bool is_volume = texels.shape == TextureTexels::Shape::volume;
    ImageShape shape;
    shape.format = texels.is_depth ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
    shape.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    shape.aspect = texels.is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    shape.shape = texels.shape;
    shape.width = static_cast<std::uint32_t>(texels.width);
    shape.height = static_cast<std::uint32_t>(texels.height);
    shape.layers = static_cast<std::uint32_t>(texels.layers);
    if (!texels.smaller.empty())
        shape.levels = static_cast<std::uint32_t>(texels.smaller.size() + 1);
    else if (texels.has_levels)
        shape.levels = static_cast<std::uint32_t>(std::bit_width(std::max(shape.width, shape.height)));
    GOBO_TRY(const DeviceImage image, make_image(shape));
    std::vector<float> all = texels.values;
    std::vector<VkBufferImageCopy> copies;
    std::vector<float> level = texels.values;
    std::size_t offset = 0;
    for (std::uint32_t number = 0, width = shape.width, height = shape.height; number < shape.levels;
         ++number) {
        VkBufferImageCopy copy{};
        copy.bufferOffset = offset * sizeof(float);
        copy.imageSubresource = {shape.aspect, number, 0, is_volume ? 1 : shape.layers};
        copy.imageExtent = {width, height, is_volume ? shape.layers : 1};
        copies.push_back(copy);
        offset += level.size();
        if (number + 1 == shape.levels) break;
        level = texels.smaller.empty() ? halved(level, width, height, shape.layers) : texels.smaller[number];
        all.insert(all.end(), level.begin(), level.end());
        width = std::max(width / 2, 1U);
        height = std::max(height / 2, 1U);
    }
    GOBO_TRY(const Buffer buffer,
             make_buffer(VK_BUFFER_USAGE_TRANSFER_SRC_BIT, all.data(), all.size() * sizeof(float)));
    GOBO_TRY_DO(run([&](VkCommandBuffer commands) {
        change_layout(vk, commands, image.image, shape, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        vk.vkCmdCopyBufferToImage(commands, buffer.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                  size_of(copies), copies.data());
        change_layout(vk, commands, image.image, shape, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }));
    return image;
}

Result<void> Resources::run(const std::function<void(VkCommandBuffer)>& record) const {
    const Device::State& device = state();
    const Functions& vk = device.vk;
    auto allocation = made<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool = device.commands;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    GOBO_VULKAN_CALL(vkAllocateCommandBuffers, device.device, &allocation, &commands);
    auto begin = made<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    GOBO_VULKAN_CALL(vkBeginCommandBuffer, commands, &begin);
    record(commands);
    GOBO_VULKAN_CALL(vkEndCommandBuffer, commands);
    auto submission = made<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submission.commandBufferCount = 1;
    submission.pCommandBuffers = &commands;
    GOBO_VULKAN_CALL(vkQueueSubmit, device.queue, 1, &submission, VK_NULL_HANDLE);
    GOBO_VULKAN_CALL(vkQueueWaitIdle, device.queue);
    vk.vkFreeCommandBuffers(device.device, device.commands, 1, &commands);
    return {};
}

void change_layout(const Functions& vk, VkCommandBuffer commands, VkImage image, const ImageShape& shape,
                   VkImageLayout from, VkImageLayout to) {
    auto barrier = made<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {shape.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                            0, 0, nullptr, 0, nullptr, 1, &barrier);
}

}  // namespace gobo::vulkan
