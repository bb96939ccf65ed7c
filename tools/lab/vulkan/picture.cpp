#include "lab/vulkan/picture.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "lab/vulkan/resources.hpp"
#include "spirv/module.hpp"

namespace gobo::vulkan {
namespace {

/// VkShaderStageFlagBits: bit by bit in the order of the pipeline, as gobo has the stages.
VkShaderStageFlagBits stage_bit(StageKind kind) {
    return static_cast<VkShaderStageFlagBits>(1U << static_cast<unsigned>(kind));
}

bool has_stage(const std::vector<StageModule>& stages, StageKind kind) {
    return std::any_of(stages.begin(), stages.end(),
                       [&](const StageModule& stage) { return stage.kind == kind; });
}

/// As what the triangles of a mesh are drawn.
Result<VkPrimitiveTopology> topology_of(const std::vector<StageModule>& stages) {
    if (has_stage(stages, StageKind::tess_evaluation)) return VK_PRIMITIVE_TOPOLOGY_PATCH_LIST;
    for (const StageModule& stage : stages) {
        if (stage.kind != StageKind::geometry) continue;
        GOBO_TRY(const spirv::Module module, spirv::read_module(stage.words));
        for (const spirv::Instruction& instruction : module.instructions) {
            if (instruction.opcode != spv::OpExecutionMode) continue;
            const auto mode = instruction.as<spv::ExecutionMode>(2);
            if (mode == spv::ExecutionModeInputPoints) return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
            if (mode == spv::ExecutionModeTriangles) return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        }
        return fail(Fault::input, "the renderer draws triangles or points, the geometry stage takes others",
                    "it can draw layout(triangles) in and layout(points) in");
    }
    return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
}

/// A vertex stage that does nothing.
constexpr std::array<std::uint32_t, 29> kNothing = {spv::MagicNumber,
                                                    0x10000,
                                                    0,
                                                    5,
                                                    0,
                                                    2U << spv::WordCountShift | spv::OpCapability,
                                                    spv::CapabilityShader,
                                                    3U << spv::WordCountShift | spv::OpMemoryModel,
                                                    spv::AddressingModelLogical,
                                                    spv::MemoryModelGLSL450,
                                                    5U << spv::WordCountShift | spv::OpEntryPoint,
                                                    spv::ExecutionModelVertex,
                                                    1,
                                                    0x6e69616d,
                                                    0,  // "main"
                                                    2U << spv::WordCountShift | spv::OpTypeVoid,
                                                    2,
                                                    3U << spv::WordCountShift | spv::OpTypeFunction,
                                                    3,
                                                    2,
                                                    5U << spv::WordCountShift | spv::OpFunction,
                                                    2,
                                                    1,
                                                    0,
                                                    3,
                                                    2U << spv::WordCountShift | spv::OpLabel,
                                                    4,
                                                    1U << spv::WordCountShift | spv::OpReturn,
                                                    1U << spv::WordCountShift | spv::OpFunctionEnd};

/// Components of 32 bits.
VkFormat format_of(int components, bool is_integer) {
    const int first = is_integer ? VK_FORMAT_R32_SINT : VK_FORMAT_R32_SFLOAT;
    return static_cast<VkFormat>(first + 3 * (components - 1));
}

/// What is drawn to: colour and depth, or depth alone.
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

/// How much a pass of depths moves surfaces away.
struct DepthBias {
    float slope = 0;
    float units = 0;
};

/// A vertex attribute of one object: its values, the same for all vertices where `stride` is 0.
struct AttributeBuffer {
    std::uint32_t location = 0;
    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    std::uint32_t stride = 0;
    VkBuffer buffer = VK_NULL_HANDLE;
};

/// One object ready to be drawn.
struct Item {
    std::vector<AttributeBuffer> attributes;
    std::vector<VkDescriptorSet> sets;
    VkBuffer indices = VK_NULL_HANDLE;
    std::uint32_t index_count = 0;
    VkCullModeFlags culled = VK_CULL_MODE_NONE;
    std::vector<std::byte> pushed;
};

/// Draws objects by the stages of one permutation to a target.
class Drawing {
  public:
    Drawing(Resources& resources, const std::vector<StageModule>& stages, const Interface& interface,
            const Target& target, DepthBias bias)
        : resources_(resources), stages_(stages), interface_(interface), target_(target), bias_(bias) {}

    Result<void> prepare(const std::vector<Object>& objects, const std::vector<RenderValue>& values,
                         const ViewedObject& view, const Textures& textures) {
        GOBO_TRY(topology_, topology_of(stages_));
        GOBO_TRY_DO(make_layouts());
        GOBO_TRY_DO(make_pool(objects.size()));
        GOBO_TRY_DO(make_textures(values, textures));
        for (const Object& object : objects) GOBO_TRY_DO(add(object, values, view));
        return make_pipelines();
    }

    void draw(VkCommandBuffer commands, const std::array<float, 4>& background) const {
        const Functions& vk = resources_.state().vk;
        std::vector<VkClearValue> cleared;
        VkClearValue value{};
        std::copy(background.begin(), background.end(), value.color.float32);
        if (target_.has_color) cleared.push_back(value);
        value.depthStencil = {1, 0};
        cleared.push_back(value);
        auto begin = made<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
        begin.renderPass = target_.pass;
        begin.framebuffer = target_.framebuffer;
        begin.renderArea = {{0, 0}, target_.extent};
        begin.clearValueCount = size_of(cleared);
        begin.pClearValues = cleared.data();
        vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
        for (std::size_t i = 0; i < items_.size(); ++i) {
            const Item& item = items_[i];
            if (item.index_count == 0) continue;
            if (!item.sets.empty())
                vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0,
                                           size_of(item.sets), item.sets.data(), 0, nullptr);
            vk.vkCmdBindIndexBuffer(commands, item.indices, 0, VK_INDEX_TYPE_UINT32);
            if (nothing_ != VK_NULL_HANDLE) {
                vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, nothing_);
                vk.vkCmdDrawIndexed(commands, 3, 1, 0, 0, 0);
            }
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[i]);
            const VkDeviceSize start = 0;
            for (std::uint32_t binding = 0; binding < size_of(item.attributes); ++binding)
                vk.vkCmdBindVertexBuffers(commands, binding, 1, &item.attributes[binding].buffer, &start);
            if (!item.pushed.empty())
                vk.vkCmdPushConstants(commands, layout_, push_stages_, 0, size_of(item.pushed),
                                      item.pushed.data());
            vk.vkCmdDrawIndexed(commands, item.index_count, 1, 0, 0, 0);
        }
        vk.vkCmdEndRenderPass(commands);
    }

    [[nodiscard]] Diagnostics take_warnings() { return std::move(warnings_); }

  private:
    void warn(Diagnostic warning) {
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
            warnings_.push_back(std::move(warning));
    }

    /// The bindings of each set, those below the highest without any too.
    Result<void> make_layouts() {
        const Functions& vk = resources_.state().vk;
        const auto add = [&](const auto& entry, VkDescriptorType type, int count) {
            const auto set = static_cast<std::size_t>(std::max(entry.set, 0));
            const auto binding = static_cast<std::uint32_t>(entry.binding);
            VkShaderStageFlags stages = 0;
            for (const std::string& name : entry.stages)
                if (const auto kind = stage_named(name)) stages |= stage_bit(*kind);
            bindings_.resize(std::max(bindings_.size(), set + 1));
            for (VkDescriptorSetLayoutBinding& other : bindings_[set])
                if (other.binding == binding) {  // another element of an array of blocks
                    ++other.descriptorCount;
                    other.stageFlags |= stages;
                    return;
                }
            bindings_[set].push_back({binding, type, static_cast<std::uint32_t>(count), stages, nullptr});
        };
        for (const Block& block : interface_.blocks) add(block, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1);
        if (!interface_.storage_blocks.empty())
            return fail(Fault::input, fmt::format("the renderer has no contents for the storage block '{}'",
                                                  interface_.storage_blocks.front().name));
        for (const Sampler& sampler : interface_.samplers)
            add(sampler, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, element_count(sampler.array));
        for (const std::vector<VkDescriptorSetLayoutBinding>& set : bindings_) {
            auto info =
                made<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
            info.bindingCount = size_of(set);
            info.pBindings = set.data();
            GOBO_TRY(const VkDescriptorSetLayout layout,
                     resources_.make<VkDescriptorSetLayout>("vkCreateDescriptorSetLayout",
                                                            vk.vkCreateDescriptorSetLayout,
                                                            vk.vkDestroyDescriptorSetLayout, info));
            set_layouts_.push_back(layout);
        }
        auto info = made<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
        info.setLayoutCount = size_of(set_layouts_);
        info.pSetLayouts = set_layouts_.data();
        VkPushConstantRange range{};
        for (const Block& block : interface_.push_constants) {
            range.size = std::max(range.size, static_cast<std::uint32_t>(block.size));
            for (const std::string& stage : block.stages)
                if (const auto kind = stage_named(stage)) push_stages_ |= stage_bit(*kind);
        }
        range.stageFlags = push_stages_;
        info.pushConstantRangeCount = range.size > 0 ? 1 : 0;
        info.pPushConstantRanges = &range;
        GOBO_TRY(layout_,
                 resources_.make<VkPipelineLayout>("vkCreatePipelineLayout", vk.vkCreatePipelineLayout,
                                                   vk.vkDestroyPipelineLayout, info));
        return {};
    }

    Result<void> make_pool(std::size_t objects) {
        if (set_layouts_.empty() || objects == 0) return {};
        const Functions& vk = resources_.state().vk;
        std::map<VkDescriptorType, std::uint32_t> counts;
        for (const auto& set : bindings_)
            for (const VkDescriptorSetLayoutBinding& binding : set)
                counts[binding.descriptorType] +=
                    binding.descriptorCount * static_cast<std::uint32_t>(objects);
        std::vector<VkDescriptorPoolSize> sizes;
        for (const auto& [type, count] : counts) sizes.push_back({type, count});
        auto info = made<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
        info.maxSets = size_of(set_layouts_) * static_cast<std::uint32_t>(objects);
        info.poolSizeCount = size_of(sizes);
        info.pPoolSizes = sizes.data();
        GOBO_TRY(pool_, resources_.make<VkDescriptorPool>("vkCreateDescriptorPool", vk.vkCreateDescriptorPool,
                                                          vk.vkDestroyDescriptorPool, info));
        return {};
    }

    Result<VkSampler> make_sampler(const TextureTexels& texels) {
        const Functions& vk = resources_.state().vk;
        auto info = made<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
        info.magFilter = info.minFilter = VK_FILTER_LINEAR;
        info.mipmapMode = texels.has_levels ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
        info.addressModeU = info.addressModeV = info.addressModeW =
            texels.repeats ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        info.maxLod = texels.has_levels ? VK_LOD_CLAMP_NONE : 0;
        info.compareEnable = texels.is_depth ? VK_TRUE : VK_FALSE;
        info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
        return resources_.make<VkSampler>("vkCreateSampler", vk.vkCreateSampler, vk.vkDestroySampler, info);
    }

    /// Of each sampler what it is given, else what the renderer has.
    Result<void> make_textures(const std::vector<RenderValue>& values, const Textures& given) {
        for (const Sampler& sampler : interface_.samplers) {
            std::optional<TextureTexels> texels;
            const TextureSource source = texture_source_of(sampler.name, values);
            const RenderValue* value = find_value(values, sampler.name);
            if (const auto found = given.find(sampler.name); found != given.end())
                texels = found->second;
            else if (value != nullptr && !source.name.empty() &&
                     std::ranges::find(texture_sources(), source.name) == texture_sources().end())
                return unknown_source(*value, texture_sources());
            else
                texels = usual_texels(sampler.type, source, TextureLevels::all);
            if (!texels)
                return fail(Fault::input, fmt::format("the renderer has no texture for '{}' of type {}",
                                                      sampler.name, sampler.type));
            GOBO_TRY(const DeviceImage image, resources_.make_texture(*texels));
            GOBO_TRY(const VkSampler handle, make_sampler(*texels));
            textures_[sampler.name] = {handle, image.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        }
        return {};
    }

    Result<void> add(const Object& object, const std::vector<RenderValue>& values, ViewedObject view) {
        view.model = object.model;
        std::vector<RenderValue> all = values;
        all.insert(all.end(), object.values.begin(), object.values.end());
        GOBO_TRY(const ResolvedUniforms resolved, resolve_uniforms(interface_, all, view));
        for (const Diagnostic& diagnostic : resolved.warnings) warn(diagnostic);
        Item item;
        GOBO_TRY_DO(add_sets(item, resolved));
        GOBO_TRY_DO(add_attributes(item, object.mesh, all));
        std::vector<std::uint32_t> indices = object.mesh.indices;
        // Vulkan takes flat values from the first vertex of a triangle, OpenGL from the last.
        if (topology_ == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST && !has_stage(stages_, StageKind::geometry))
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
                std::rotate(&indices[i], &indices[i + 2], &indices[i] + 3);
        GOBO_TRY(const Buffer buffer, resources_.make_buffer(VK_BUFFER_USAGE_INDEX_BUFFER_BIT, indices.data(),
                                                             indices.size() * sizeof(std::uint32_t)));
        item.indices = buffer.buffer;
        item.index_count = size_of(indices);
        if (object.culls_back_faces)
            item.culled = object.is_mirrored() ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
        for (const Block& block : interface_.push_constants) {
            const std::vector<std::byte> bytes = bytes_of(block, resolved.assignments);
            item.pushed.resize(std::max(item.pushed.size(), bytes.size()));
            std::copy(bytes.begin(), bytes.end(), item.pushed.begin());
        }
        items_.push_back(std::move(item));
        return {};
    }

    Result<void> add_sets(Item& item, const ResolvedUniforms& resolved) {
        if (set_layouts_.empty()) return {};
        const Device::State& state = resources_.state();
        const Functions& vk = state.vk;
        item.sets.resize(set_layouts_.size());
        auto info = made<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
        info.descriptorPool = pool_;
        info.descriptorSetCount = size_of(set_layouts_);
        info.pSetLayouts = set_layouts_.data();
        GOBO_VULKAN_CALL(vkAllocateDescriptorSets, state.device, &info, item.sets.data());
        std::map<std::pair<int, int>, std::uint32_t> elements;  // of arrays of blocks so far
        for (const Block& block : interface_.blocks) {
            const std::vector<std::byte> bytes = bytes_of(block, resolved.assignments);
            GOBO_TRY(const Buffer buffer,
                     resources_.make_buffer(VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, bytes.data(), bytes.size()));
            const VkDescriptorBufferInfo range{buffer.buffer, 0, VK_WHOLE_SIZE};
            auto write = made<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
            write.dstSet = item.sets[static_cast<std::size_t>(block.set)];
            write.dstBinding = static_cast<std::uint32_t>(block.binding);
            write.dstArrayElement = elements[{block.set, block.binding}]++;
            write.descriptorCount = 1;
            write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
            write.pBufferInfo = &range;
            vk.vkUpdateDescriptorSets(state.device, 1, &write, 0, nullptr);
        }
        for (const Sampler& sampler : interface_.samplers) {
            const std::vector<VkDescriptorImageInfo> images(
                static_cast<std::size_t>(element_count(sampler.array)), textures_.at(sampler.name));
            auto write = made<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
            write.dstSet = item.sets[static_cast<std::size_t>(sampler.set)];
            write.dstBinding = static_cast<std::uint32_t>(sampler.binding);
            write.descriptorCount = size_of(images);
            write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            write.pImageInfo = images.data();
            vk.vkUpdateDescriptorSets(state.device, 1, &write, 0, nullptr);
        }
        return {};
    }

    /// Attributes of one location.
    Result<void> add_attributes(Item& item, const Mesh& mesh, const std::vector<RenderValue>& values) {
        for (const Variable& input : interface_.inputs) {
            const GlslType type = glsl_type(input.type).value_or(GlslType{});
            if (type.is_matrix() || !input.array.empty())
                return fail(Fault::input,
                            fmt::format("the renderer has no values for the attribute '{}' of type "
                                        "{}",
                                        input.name, input.type));
            AttributeBuffer attribute;
            attribute.location = static_cast<std::uint32_t>(input.location);
            const bool is_integer = type.scalar != Scalar::float32;
            const RenderValue* value = find_value(values, input.name);
            const std::string source(value != nullptr ? value->source : attribute_source_of(input.name));
            AttributeValues constant{4, {0, 0, 0, 0}, {}};
            std::optional<AttributeValues> own;
            if (value != nullptr && source.empty()) {
                constant.floats = {0, 0, 0, 1};  // what is lacking
                for (std::size_t i = 0; i < std::min<std::size_t>(value->numbers.size(), 4); ++i)
                    constant.floats[i] = static_cast<float>(value->numbers[i]);
            } else if (own = attribute_values(mesh, source); own) {
            } else if (source == "color") {
                constant.floats = {1, 1, 1, 1};
            } else if (value != nullptr) {
                return unknown_source(*value, attribute_sources());
            } else {
                warn(no_value(fmt::format("the attribute '{}' has no value and stays 0", input.name)));
            }
            AttributeValues& given = own ? *own : constant;
            if (is_integer && given.integers.empty())
                for (const float number : given.floats)
                    given.integers.push_back(static_cast<std::int32_t>(number));
            const bool has_integers = !given.integers.empty();
            attribute.format = format_of(given.components, has_integers);
            attribute.stride = own ? 4 * static_cast<std::uint32_t>(given.components) : 0;
            const void* data = has_integers ? static_cast<const void*>(given.integers.data())
                                            : static_cast<const void*>(given.floats.data());
            const std::size_t count = has_integers ? given.integers.size() : given.floats.size();
            GOBO_TRY(const Buffer buffer,
                     resources_.make_buffer(VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, data, 4 * count));
            attribute.buffer = buffer.buffer;
            item.attributes.push_back(attribute);
        }
        return {};
    }

    /// One for each way in which objects are culled and bring their attributes.
    Result<void> make_pipelines() {
        const Functions& vk = resources_.state().vk;
        struct Made {
            VkShaderModule module;
            std::vector<std::uint32_t> values;
            std::vector<VkSpecializationMapEntry> entries;
            VkSpecializationInfo specialization;
        };
        std::vector<Made> modules(stages_.size());
        std::vector<VkPipelineShaderStageCreateInfo> stages;
        for (std::size_t i = 0; i < stages_.size(); ++i) {
            Made& own = modules[i];
            auto info = made<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
            info.codeSize = stages_[i].words.size_bytes();
            info.pCode = stages_[i].words.data();
            GOBO_TRY(own.module,
                     resources_.make<VkShaderModule>("vkCreateShaderModule", vk.vkCreateShaderModule,
                                                     vk.vkDestroyShaderModule, info));
            for (const SpecializedCount& count : stages_[i].specialized) {
                own.entries.push_back({static_cast<std::uint32_t>(count.id),
                                       static_cast<std::uint32_t>(4 * own.values.size()), 4});
                own.values.push_back(static_cast<std::uint32_t>(count.value));
            }
            own.specialization = {size_of(own.entries), own.entries.data(), 4 * own.values.size(),
                                  own.values.data()};
            auto stage =
                made<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
            stage.stage = stage_bit(stages_[i].kind);
            stage.module = own.module;
            stage.pName = "main";
            stage.pSpecializationInfo = &own.specialization;
            stages.push_back(stage);
        }
        GOBO_TRY_DO(make_nothing());
        std::map<std::vector<std::uint32_t>, VkPipeline> known;
        for (const Item& item : items_) {
            std::vector<std::uint32_t> kind = {item.culled};
            for (const AttributeBuffer& attribute : item.attributes)
                kind.insert(kind.end(), {attribute.location, static_cast<std::uint32_t>(attribute.format),
                                         attribute.stride});
            const auto [place, is_new] = known.try_emplace(std::move(kind), VK_NULL_HANDLE);
            if (is_new) {
                GOBO_TRY(place->second, make_pipeline(item, stages));
            }
            pipelines_.push_back(place->second);
        }
        return {};
    }

    /// lavapipe of Mesa 22.3.6 dies where uniform buffers are new to a large stage, in which it wants to
    /// write their values as constants. A pipeline that draws nothing takes them first.
    Result<void> make_nothing() {
        if (resources_.state().name.find("llvmpipe") == std::string::npos) return {};
        const Functions& vk = resources_.state().vk;
        auto info = made<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
        info.codeSize = sizeof kNothing;
        info.pCode = kNothing.data();
        auto stage =
            made<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
        stage.stage = VK_SHADER_STAGE_VERTEX_BIT;
        stage.pName = "main";
        GOBO_TRY(stage.module,
                 resources_.make<VkShaderModule>("vkCreateShaderModule", vk.vkCreateShaderModule,
                                                 vk.vkDestroyShaderModule, info));
        GOBO_TRY(nothing_, make_pipeline({}, {stage}, true));
        return {};
    }

    Result<VkPipeline> make_pipeline(const Item& item,
                                     const std::vector<VkPipelineShaderStageCreateInfo>& stages,
                                     bool draws_nothing = false) {
        const Device::State& state = resources_.state();
        const Functions& vk = state.vk;
        std::vector<VkVertexInputBindingDescription> buffers;
        std::vector<VkVertexInputAttributeDescription> attributes;
        for (const AttributeBuffer& attribute : item.attributes) {
            const std::uint32_t binding = size_of(buffers);
            buffers.push_back({binding, attribute.stride, VK_VERTEX_INPUT_RATE_VERTEX});
            attributes.push_back({attribute.location, binding, attribute.format, 0});
        }
        auto inputs = made<VkPipelineVertexInputStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
        inputs.vertexBindingDescriptionCount = size_of(buffers);
        inputs.pVertexBindingDescriptions = buffers.data();
        inputs.vertexAttributeDescriptionCount = size_of(attributes);
        inputs.pVertexAttributeDescriptions = attributes.data();
        auto assembly = made<VkPipelineInputAssemblyStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
        assembly.topology = draws_nothing ? VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST : topology_;
        auto tessellation = made<VkPipelineTessellationStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO);
        tessellation.patchControlPoints = 3;
        const VkViewport area{
            0, 0, static_cast<float>(target_.extent.width), static_cast<float>(target_.extent.height), 0, 1};
        const VkRect2D scissor{{0, 0}, target_.extent};
        auto viewport =
            made<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
        viewport.viewportCount = viewport.scissorCount = 1;
        viewport.pViewports = &area;
        viewport.pScissors = &scissor;
        auto rasterization = made<VkPipelineRasterizationStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
        rasterization.rasterizerDiscardEnable = draws_nothing ? VK_TRUE : VK_FALSE;
        rasterization.cullMode = item.culled;
        rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
        rasterization.lineWidth = 1;
        rasterization.depthBiasEnable = bias_.slope != 0 || bias_.units != 0 ? VK_TRUE : VK_FALSE;
        rasterization.depthBiasConstantFactor = bias_.units;
        rasterization.depthBiasSlopeFactor = bias_.slope;
        auto samples = made<VkPipelineMultisampleStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        auto depth = made<VkPipelineDepthStencilStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
        depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
        depth.depthCompareOp = VK_COMPARE_OP_LESS;
        VkPipelineColorBlendAttachmentState all_written{};
        all_written.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                     VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
        auto blending = made<VkPipelineColorBlendStateCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
        blending.attachmentCount = target_.has_color ? 1 : 0;
        blending.pAttachments = &all_written;
        auto info = made<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
        info.stageCount = size_of(stages);
        info.pStages = stages.data();
        info.pVertexInputState = &inputs;
        info.pInputAssemblyState = &assembly;
        if (assembly.topology == VK_PRIMITIVE_TOPOLOGY_PATCH_LIST) info.pTessellationState = &tessellation;
        info.pViewportState = &viewport;
        info.pRasterizationState = &rasterization;
        info.pMultisampleState = &samples;
        info.pDepthStencilState = &depth;
        info.pColorBlendState = &blending;
        info.layout = layout_;
        info.renderPass = target_.pass;
        VkPipeline pipeline = VK_NULL_HANDLE;
        GOBO_VULKAN_CALL(vkCreateGraphicsPipelines, state.device, VK_NULL_HANDLE, 1, &info, nullptr,
                         &pipeline);
        resources_.keep([&state, pipeline] { state.vk.vkDestroyPipeline(state.device, pipeline, nullptr); });
        return pipeline;
    }

    Resources& resources_;
    const std::vector<StageModule>& stages_;
    const Interface& interface_;
    const Target& target_;
    DepthBias bias_;
    VkPrimitiveTopology topology_ = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    std::vector<std::vector<VkDescriptorSetLayoutBinding>> bindings_;  ///< by set
    std::vector<VkDescriptorSetLayout> set_layouts_;
    VkShaderStageFlags push_stages_ = 0;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::map<std::string, VkDescriptorImageInfo> textures_;
    std::vector<Item> items_;
    std::vector<VkPipeline> pipelines_;  ///< one for each item
    VkPipeline nothing_ = VK_NULL_HANDLE;
    Diagnostics warnings_;
};

/// Draws, and reads what came of it.
Result<Picture> take_picture(Resources& resources, const Target& target, const Drawing& drawing,
                             const std::array<float, 4>& background) {
    const Functions& vk = resources.state().vk;
    const std::size_t pixels = std::size_t{target.extent.width} * target.extent.height;
    const auto width = static_cast<int>(target.extent.width);
    const auto height = static_cast<int>(target.extent.height);
    Picture picture;
    picture.depth = Image(width, height, 1);
    if (target.has_color) picture.color = Image(width, height, 4);
    GOBO_TRY(const Buffer colors,
             resources.make_buffer(VK_BUFFER_USAGE_TRANSFER_DST_BIT, nullptr, 4 * sizeof(float) * pixels));
    GOBO_TRY(const Buffer depths,
             resources.make_buffer(VK_BUFFER_USAGE_TRANSFER_DST_BIT, nullptr, sizeof(float) * pixels));
    const auto read = [&](VkCommandBuffer commands, const DeviceImage& image, const ImageShape& shape,
                          VkImageLayout layout, const Buffer& to) {
        change_layout(vk, commands, image.image, shape, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {shape.aspect, 0, 0, 1};
        copy.imageExtent = {target.extent.width, target.extent.height, 1};
        vk.vkCmdCopyImageToBuffer(commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.buffer, 1,
                                  &copy);
    };
    GOBO_TRY_DO(resources.run([&](VkCommandBuffer commands) {
        drawing.draw(commands, background);
        if (target.has_color)
            read(commands, target.color, target.color_shape, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                 colors);
        read(commands, target.depth, target.depth_shape, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
             depths);
        auto barrier = made<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                                &barrier, 0, nullptr, 0, nullptr);
    }));
    const auto copy = [](const Buffer& from, Image& to) {
        const auto* const first = static_cast<const float*>(from.data);
        std::copy(first, first + to.values.size(), to.values.begin());
    };
    if (target.has_color) copy(colors, picture.color);
    copy(depths, picture.depth);
    return picture;
}

}  // namespace

std::vector<StageModule> modules_of(const std::vector<std::span<const std::uint32_t>>& modules,
                                    const Permutation& permutation) {
    std::vector<StageModule> stages;
    for (const StageNames& stage : kStages)
        if (const int number = permutation.stages[stage.kind]; number >= 0)
            stages.push_back(
                {stage.kind, modules[static_cast<std::size_t>(number)], permutation.specialized});
    return stages;
}

glm::dmat4 clip_space_of_maps() {
    glm::dmat4 matrix(1);
    matrix[2][2] = 0.5;  // z' = z / 2 + w / 2
    matrix[3][2] = 0.5;
    return matrix;
}

glm::dmat4 clip_space_of_pictures() {
    glm::dmat4 matrix = clip_space_of_maps();
    matrix[1][1] = -1;
    return matrix;
}

Result<Picture> render_permutation(const Device& device, const std::vector<StageModule>& stages,
                                   const Interface& interface, const std::vector<Object>& objects,
                                   const std::vector<RenderValue>& values, const View& view,
                                   const Textures& textures) {
    Resources resources(device);
    GOBO_TRY(const Target target, make_target(resources, view.width, view.height, true));
    Drawing drawing(resources, stages, interface, target, {});
    ViewedObject viewed = viewed_from(view);
    viewed.projection = clip_space_of_pictures() * viewed.projection;
    GOBO_TRY_DO(drawing.prepare(objects, values, viewed, textures));
    GOBO_TRY(Picture picture, take_picture(resources, target, drawing, view.background));
    picture.warnings = drawing.take_warnings();
    if (Diagnostics messages = device.messages(); !messages.empty())
        return tl::unexpected(std::move(messages));
    return picture;
}

Result<std::vector<Image>> draw_shadow_maps(const Device& device, const ShadowPass& pass,
                                            const ShadowPlan& plan, const std::vector<Object>& objects) {
    std::vector<Image> maps;
    for (const ShadowCamera& camera : plan.cameras) {
        Resources resources(device);
        GOBO_TRY(const Target target, make_target(resources, pass.side, pass.side, false));
        Drawing drawing(resources, pass.stages, pass.interface, target,
                        {static_cast<float>(pass.slope), static_cast<float>(pass.units)});
        const ViewedObject viewed{
            glm::dmat4(1), camera.view, clip_space_of_maps() * camera.projection, {pass.side, pass.side}};
        GOBO_TRY_DO(drawing.prepare(objects, pass.values, viewed, {}));
        GOBO_TRY(Picture picture, take_picture(resources, target, drawing, {}));
        maps.push_back(std::move(picture.depth));
    }
    if (Diagnostics messages = device.messages(); !messages.empty())
        return tl::unexpected(std::move(messages));
    return maps;
}

}  // namespace gobo::vulkan
