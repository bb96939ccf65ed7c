// spheres FILE.png: a sphere under one light beside one under three, by two pipelines of the same SPIR-V.
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>

#include <lodepng.h>
#define GLM_FORCE_DEPTH_ZERO_TO_ONE  // Vulkan's clip space: depth from 0 to 1
#include <glm/gtc/matrix_transform.hpp>

// vulkan.hpp stands behind vulkan.h, which device.hpp includes.
// clang-format off
#include "device.hpp"
#include <gobo/vulkan.hpp>
#include "lit.hpp"
// clang-format on

namespace spheres {
namespace {

constexpr VkExtent2D kSize{640, 320};
constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_SRGB;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
};

Mesh make_sphere(std::uint32_t slices, std::uint32_t stacks) {
    Mesh mesh;
    const float pi = std::acos(-1.0F);
    for (std::uint32_t stack = 0; stack <= stacks; ++stack)
        for (std::uint32_t slice = 0; slice <= slices; ++slice) {
            const float down = pi * static_cast<float>(stack) / static_cast<float>(stacks);
            const float round = 2 * pi * static_cast<float>(slice) / static_cast<float>(slices);
            const glm::vec3 point(std::sin(down) * std::sin(round), std::cos(down),
                                  std::sin(down) * std::cos(round));
            mesh.vertices.push_back({point, point});
        }
    for (std::uint32_t stack = 0; stack < stacks; ++stack)
        for (std::uint32_t slice = 0; slice < slices; ++slice) {
            const std::uint32_t upper = stack * (slices + 1) + slice;
            const std::uint32_t lower = upper + slices + 1;
            for (const std::uint32_t index : {upper, lower, lower + 1, upper, lower + 1, upper + 1})
                mesh.indices.push_back(index);
        }
    return mesh;
}

/// What the pipelines of all permutations share: layouts made of the header's tables.
struct Layouts {
    std::vector<VkDescriptorSetLayout> sets;
    VkPipelineLayout pipeline = VK_NULL_HANDLE;
};

Layouts make_layouts(Device& device) {
    Layouts layouts;
    for (std::uint32_t set = 0; set < gobo::vulkan::set_count(lit::descriptors); ++set) {
        const auto bindings = gobo::vulkan::layout_bindings(lit::descriptors, set);
        VkDescriptorSetLayoutCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        info.bindingCount = static_cast<std::uint32_t>(bindings.size());
        info.pBindings = bindings.data();
        VkDescriptorSetLayout layout = VK_NULL_HANDLE;
        check(vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout),
              "vkCreateDescriptorSetLayout");
        device.keep([&device, layout] { vkDestroyDescriptorSetLayout(device.handle(), layout, nullptr); });
        layouts.sets.push_back(layout);
    }
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = static_cast<std::uint32_t>(layouts.sets.size());
    info.pSetLayouts = layouts.sets.data();
    check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layouts.pipeline),
          "vkCreatePipelineLayout");
    device.keep(
        [&device, layout = layouts.pipeline] { vkDestroyPipelineLayout(device.handle(), layout, nullptr); });
    return layouts;
}

VkShaderModule make_module(Device& device, const lit::Stage& stage) {
    const VkShaderModuleCreateInfo info = gobo::vulkan::module_info(stage);
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule");
    device.keep([&device, module] { vkDestroyShaderModule(device.handle(), module, nullptr); });
    return module;
}

VkPipeline make_pipeline(Device& device, const Layouts& layouts, const lit::Permutation& permutation,
                         VkShaderModule vertex, VkShaderModule fragment) {
    using gobo::runtime::StageKind;
    const gobo::vulkan::Specialization counts(permutation);
    const std::array stages = {gobo::vulkan::stage_info(StageKind::vertex, vertex, counts.info()),
                               gobo::vulkan::stage_info(StageKind::fragment, fragment, counts.info())};
    const VkVertexInputBindingDescription buffer{0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
    const std::array attributes = {
        gobo::vulkan::vertex_attributes(lit::attribute::position, &Vertex::position)[0],
        gobo::vulkan::vertex_attributes(lit::attribute::normal, &Vertex::normal)[0]};
    VkPipelineVertexInputStateCreateInfo inputs{};
    inputs.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    inputs.vertexBindingDescriptionCount = 1;
    inputs.pVertexBindingDescriptions = &buffer;
    inputs.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    inputs.pVertexAttributeDescriptions = attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = viewport.scissorCount = 1;
    const std::array dynamic = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamics{};
    dynamics.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamics.dynamicStateCount = static_cast<std::uint32_t>(dynamic.size());
    dynamics.pDynamicStates = dynamic.data();
    VkPipelineRasterizationStateCreateInfo rasterization{};
    rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    rasterization.cullMode = VK_CULL_MODE_BACK_BIT;
    rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    rasterization.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_LESS;
    VkPipelineColorBlendAttachmentState written{};
    written.colorWriteMask = 0xf;
    VkPipelineColorBlendStateCreateInfo blending{};
    blending.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blending.attachmentCount = 1;
    blending.pAttachments = &written;
    VkPipelineRenderingCreateInfo targets{};
    targets.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    targets.colorAttachmentCount = 1;
    targets.pColorAttachmentFormats = &kColorFormat;
    targets.depthAttachmentFormat = kDepthFormat;
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &targets;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &inputs;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pDynamicState = &dynamics;
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blending;
    info.layout = layouts.pipeline;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
    device.keep([&device, pipeline] { vkDestroyPipeline(device.handle(), pipeline, nullptr); });
    return pipeline;
}

/// The sets that all pipelines are drawn with. The buffer of lights holds the most that any key counts.
std::vector<VkDescriptorSet> make_sets(Device& device, const Layouts& layouts) {
    const glm::mat4 view = glm::lookAt(glm::vec3(0, 0, 4), glm::vec3(0), glm::vec3(0, 1, 0));
    glm::mat4 projection = glm::perspective(0.7F, 1.0F, 0.1F, 20.0F);
    projection[1][1] = -projection[1][1];  // y downward
    lit::Transform transform{};
    transform.modelView = view;
    transform.projection = projection;
    transform.normalMatrix = glm::mat3(view);
    lit::Ambient ambient{};
    ambient.color = glm::vec3(0.02F);
    lit::Material material{};
    material.ambient = material.diffuse = glm::vec3(0.8F);
    material.specular = glm::vec3(0.3F);
    material.shininess = 40;
    material.strength = 1;
    lit::PointLights lights{};
    const std::array<glm::vec3, 3> colors = {glm::vec3(1, 0.9F, 0.8F), glm::vec3(0.2F, 0.4F, 1),
                                             glm::vec3(1, 0.2F, 0.1F)};
    const std::array<glm::vec3, 3> positions = {glm::vec3(-1, 2, 2), glm::vec3(3, 0, 1),
                                                glm::vec3(-1, -3, 1)};
    for (std::size_t i = 0; i < colors.size(); ++i) {
        lights.lights[i].position = view * glm::vec4(positions[i], 1);
        lights.lights[i].color = colors[i];
        lights.lights[i].attenuation = glm::vec3(1, 0, 0);
    }

    const std::array sizes = {VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 8}};
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = static_cast<std::uint32_t>(layouts.sets.size());
    pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device.handle(), &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
    device.keep([&device, pool] { vkDestroyDescriptorPool(device.handle(), pool, nullptr); });
    std::vector<VkDescriptorSet> sets(layouts.sets.size());
    VkDescriptorSetAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocation.descriptorPool = pool;
    allocation.descriptorSetCount = static_cast<std::uint32_t>(sets.size());
    allocation.pSetLayouts = layouts.sets.data();
    check(vkAllocateDescriptorSets(device.handle(), &allocation, sets.data()), "vkAllocateDescriptorSets");
    const auto bind = [&](const auto& block) {
        using Block = std::decay_t<decltype(block)>;
        const Buffer buffer = device.make_buffer(VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, &block, sizeof block);
        const VkDescriptorBufferInfo range{buffer.buffer, 0, VK_WHOLE_SIZE};
        const VkWriteDescriptorSet write = gobo::vulkan::write_block<Block>(sets[Block::set], range);
        vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
    };
    bind(transform);
    bind(ambient);
    bind(material);
    bind(lights);
    return sets;
}

void run(const char* file) {
    Device device;
    const Layouts layouts = make_layouts(device);
    const std::vector<VkDescriptorSet> sets = make_sets(device, layouts);
    const Mesh mesh = make_sphere(64, 32);
    const Buffer vertices = device.make_buffer(VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, mesh.vertices.data(),
                                               mesh.vertices.size() * sizeof(Vertex));
    const Buffer indices = device.make_buffer(VK_BUFFER_USAGE_INDEX_BUFFER_BIT, mesh.indices.data(),
                                              mesh.indices.size() * sizeof(std::uint32_t));
    std::vector<VkPipeline> pipelines;
    const lit::Stage* known = nullptr;
    VkShaderModule vertex = VK_NULL_HANDLE;
    VkShaderModule fragment = VK_NULL_HANDLE;
    for (const int count : {1, 3}) {
        lit::Key key;
        key.point = count;
        key.specular = lit::Specular::blinn;
        const lit::Permutation* permutation = lit::find(key);
        if (permutation == nullptr) throw std::runtime_error(lit::describe_missing(key));
        const bool is_same = known != nullptr && *known == permutation->fragment;
        if (!is_same) {
            vertex = make_module(device, permutation->vertex);
            fragment = make_module(device, permutation->fragment);
        }
        known = &permutation->fragment;
        pipelines.push_back(make_pipeline(device, layouts, *permutation, vertex, fragment));
        std::printf("%s: %s\n", lit::key_text(key).c_str(), is_same ? "the same SPIR-V" : "new SPIR-V");
    }
    const Image color =
        device.make_image(kColorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                          VK_IMAGE_ASPECT_COLOR_BIT, kSize);
    const Image depth = device.make_image(kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                          VK_IMAGE_ASPECT_DEPTH_BIT, kSize);
    const Buffer picture = device.make_buffer(VK_BUFFER_USAGE_TRANSFER_DST_BIT, nullptr,
                                              std::size_t{4} * kSize.width * kSize.height);
    device.run([&](VkCommandBuffer commands) {
        change_layout(commands, color.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        change_layout(commands, depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
        VkRenderingAttachmentInfo to_color{};
        to_color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        to_color.imageView = color.view;
        to_color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        to_color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        to_color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        to_color.clearValue.color = {{0.01F, 0.01F, 0.02F, 1}};
        VkRenderingAttachmentInfo to_depth = to_color;
        to_depth.imageView = depth.view;
        to_depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
        to_depth.clearValue.depthStencil = {1, 0};
        VkRenderingInfo rendering{};
        rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
        rendering.renderArea = {{0, 0}, kSize};
        rendering.layerCount = 1;
        rendering.colorAttachmentCount = 1;
        rendering.pColorAttachments = &to_color;
        rendering.pDepthAttachment = &to_depth;
        vkCmdBeginRendering(commands, &rendering);
        const VkDeviceSize start = 0;
        vkCmdBindVertexBuffers(commands, 0, 1, &vertices.buffer, &start);
        vkCmdBindIndexBuffer(commands, indices.buffer, 0, VK_INDEX_TYPE_UINT32);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts.pipeline, 0,
                                static_cast<std::uint32_t>(sets.size()), sets.data(), 0, nullptr);
        for (std::size_t i = 0; i < pipelines.size(); ++i) {
            const float side = static_cast<float>(kSize.height);
            const VkViewport area{side * static_cast<float>(i), 0, side, side, 0, 1};
            const VkRect2D scissor{{0, 0}, kSize};
            vkCmdSetViewport(commands, 0, 1, &area);
            vkCmdSetScissor(commands, 0, 1, &scissor);
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[i]);
            vkCmdDrawIndexed(commands, static_cast<std::uint32_t>(mesh.indices.size()), 1, 0, 0, 0);
        }
        vkCmdEndRendering(commands);
        change_layout(commands, color.image, VK_IMAGE_ASPECT_COLOR_BIT,
                      VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {kSize.width, kSize.height, 1};
        vkCmdCopyImageToBuffer(commands, color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, picture.buffer, 1,
                               &copy);
    });
    const auto* const pixels = static_cast<const unsigned char*>(picture.data);
    if (lodepng_encode32_file(file, pixels, kSize.width, kSize.height) != 0)
        throw std::runtime_error(std::string("cannot write ") + file);
    std::printf("%s by %s\n", file, device.name().c_str());
}

}  // namespace
}  // namespace spheres

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: spheres FILE.png\n", stderr);
        return 2;
    }
    try {
        spheres::run(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "spheres: %s\n", error.what());
        return 1;
    }
    return 0;
}
