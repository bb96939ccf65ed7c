#include "lab/vulkan/target.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gobo::vulkan {
namespace {

VkAttachmentDescription attachment(VkFormat format, VkImageLayout layout) {
    VkAttachmentDescription description{};
    description.format = format;
    description.samples = VK_SAMPLE_COUNT_1_BIT;
    description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    description.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    description.finalLayout = layout;
    return description;
}

}  // namespace

Result<Target> make_target(Resources& resources, int width, int height, bool has_color) {
    const Functions& vk = resources.state().vk;
    const auto largest = static_cast<int>(std::min(resources.state().limits.maxFramebufferWidth,
                                                   resources.state().limits.maxFramebufferHeight));
    if (width < 1 || height < 1 || width > largest || height > largest)
        return fail(Fault::usage, fmt::format("cannot draw a picture of {} x {} pixels", width, height),
                    fmt::format("choose both from 1 to {}", largest));
    Target target;
    target.has_color = has_color;
    target.extent = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    for (ImageShape* shape : {&target.color_shape, &target.depth_shape}) {
        shape->width = target.extent.width;
        shape->height = target.extent.height;
        shape->usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    }
    target.depth_shape.format = VK_FORMAT_D32_SFLOAT;
    target.depth_shape.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    target.depth_shape.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (has_color) {
        GOBO_TRY(target.color, resources.make_image(target.color_shape));
    }
    GOBO_TRY(target.depth, resources.make_image(target.depth_shape));
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkImageView> views;
    if (has_color) {
        attachments.push_back(
            attachment(target.color_shape.format, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
        views.push_back(target.color.view);
    }
    attachments.push_back(
        attachment(target.depth_shape.format, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL));
    views.push_back(target.depth.view);
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth{has_color ? 1U : 0U, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = has_color ? 1 : 0;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;
    auto pass = made<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    pass.attachmentCount = size_of(attachments);
    pass.pAttachments = attachments.data();
    pass.subpassCount = 1;
    pass.pSubpasses = &subpass;
    GOBO_TRY(target.pass, resources.make<VkRenderPass>("vkCreateRenderPass", vk.vkCreateRenderPass,
                                                       vk.vkDestroyRenderPass, pass));
    auto framebuffer = made<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    framebuffer.renderPass = target.pass;
    framebuffer.attachmentCount = size_of(views);
    framebuffer.pAttachments = views.data();
    framebuffer.width = target.extent.width;
    framebuffer.height = target.extent.height;
    framebuffer.layers = 1;
    GOBO_TRY(target.framebuffer, resources.make<VkFramebuffer>("vkCreateFramebuffer", vk.vkCreateFramebuffer,
                                                               vk.vkDestroyFramebuffer, framebuffer));
    return target;
}

}  // namespace gobo::vulkan
