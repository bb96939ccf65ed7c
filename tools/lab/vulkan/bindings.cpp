#include "lab/vulkan/bindings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "lab/render/chosen_values.hpp"
#include "lab/render/texture.hpp"

namespace gobo::vulkan {

namespace {

VkDescriptorType descriptor_type(const Sampler& sampler) {
    if (sampler.type == "sampler") return VK_DESCRIPTOR_TYPE_SAMPLER;
    const bool is_apart = combined_type(sampler.type) != sampler.type;
    return is_apart ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

VkSamplerAddressMode address_mode(TextureLookup::Beyond beyond) {
    switch (beyond) {
        case TextureLookup::Beyond::mirror:
            return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
        case TextureLookup::Beyond::edge:
            return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        case TextureLookup::Beyond::repeat:
            break;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

}  // namespace

Result<void> Bindings::make(std::size_t objects, const std::vector<RenderValue>& values) {
    GOBO_TRY_DO(make_layouts());
    GOBO_TRY_DO(make_pool(objects));
    GOBO_TRY_DO(check_textures(interface_, values));
    for (const Sampler& sampler : interface_.samplers)
        usual_[sampler.name] =
            usual_texels(sampler.type, texture_source_of(sampler.name, values), TextureLevels::all);
    return {};
}

Result<void> Bindings::make_layouts() {
    const Functions& vk = resources_.state().vk;
    std::map<std::pair<int, int>, std::string_view> names;
    std::string shared;  // by two names, each of which has contents of its own
    const auto add = [&](const auto& entry, VkDescriptorType type, int count) {
        const std::string_view root = root_of(entry.name);
        const auto named = names.try_emplace({entry.set, entry.binding}, root).first;
        if (named->second != root)
            shared = fmt::format(
                "the renderer has contents for '{}' and for '{}', but both are at set {}, "
                "binding {}",
                named->second, root, entry.set, entry.binding);
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
        return fail(Fault::input,
                    fmt::format("the renderer has no contents for the storage block '{}'",
                                interface_.storage_blocks.front().name),
                    "leave its keys out, or have the shaders read a uniform block");
    for (const Sampler& sampler : interface_.samplers)
        add(sampler, descriptor_type(sampler), element_count(sampler.array));
    const auto apart =
        std::ranges::adjacent_find(interface_.samplers, [](const Sampler& one, const Sampler& next) {
            return one.name == next.name && one.type != next.type;
        });
    if (apart != interface_.samplers.end())
        return fail(Fault::input,
                    fmt::format("the renderer has one texture for '{}', which is a {} and a {}", apart->name,
                                apart->type, std::next(apart)->type),
                    "leave its keys out, or give them two names");
    if (!shared.empty())
        return fail(Fault::input, shared, "leave its keys out, or call it alike in all stages");
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
    GOBO_TRY(layout_, resources_.make<VkPipelineLayout>("vkCreatePipelineLayout", vk.vkCreatePipelineLayout,
                                                        vk.vkDestroyPipelineLayout, info));
    return {};
}

Result<void> Bindings::make_pool(std::size_t objects) {
    if (set_layouts_.empty() || objects == 0) return {};
    const Functions& vk = resources_.state().vk;
    std::map<VkDescriptorType, std::uint32_t> counts;
    for (const auto& set : bindings_)
        for (const VkDescriptorSetLayoutBinding& binding : set)
            counts[binding.descriptorType] += binding.descriptorCount * static_cast<std::uint32_t>(objects);
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

Result<VkSampler> Bindings::make_sampler(const TextureTexels& texels) {
    const Functions& vk = resources_.state().vk;
    auto info = made<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    const TextureLookup& lookup = texels.lookup;
    const auto filter = [](bool is_nearest) { return is_nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR; };
    info.magFilter = filter(lookup.enlarges_nearest);
    info.minFilter = filter(lookup.shrinks_nearest);
    info.mipmapMode = texels.has_levels && !lookup.nearest_level ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                                 : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = info.addressModeW = address_mode(lookup.s);
    info.addressModeV = address_mode(lookup.t);
    // Above 0, so that the first level alone is shrunk by its own filter (VkSamplerCreateInfo).
    info.maxLod = texels.has_levels ? VK_LOD_CLAMP_NONE : 0.25F;
    info.compareEnable = texels.is_depth ? VK_TRUE : VK_FALSE;
    info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    return resources_.make<VkSampler>("vkCreateSampler", vk.vkCreateSampler, vk.vkDestroySampler, info);
}

Result<VkDescriptorImageInfo> Bindings::image_of(const Sampler& sampler, const Textures& given) {
    Texels texels = usual_.at(sampler.name);
    if (const auto found = given.find(sampler.name); found != given.end()) texels = found->second;
    const bool is_sampler = sampler.type == "sampler";  // apart from its textures, whatever levels they have
    if (is_sampler && texels == nullptr) {
        TextureTexels any;
        any.has_levels = true;
        texels = usual_[sampler.name] = std::make_shared<const TextureTexels>(std::move(any));
    }
    if (texels == nullptr)
        return fail(Fault::input, fmt::format("the renderer has no texture for '{}' of type {}", sampler.name,
                                              sampler.type));
    const auto [handle, is_new] = samplers_.try_emplace(texels, VK_NULL_HANDLE);
    if (is_new) {
        GOBO_TRY(handle->second, make_sampler(*texels));
    }
    if (is_sampler) return VkDescriptorImageInfo{handle->second, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED};
    GOBO_TRY(const DeviceImage image, resources_.texture_of(texels));
    return VkDescriptorImageInfo{handle->second, image.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
}

Result<std::vector<VkDescriptorSet>> Bindings::sets_of(const ResolvedUniforms& resolved,
                                                       const Textures& given) {
    std::vector<VkDescriptorSet> sets(set_layouts_.size());
    if (sets.empty()) return sets;
    const Device::State& state = resources_.state();
    const Functions& vk = state.vk;
    auto info = made<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = pool_;
    info.descriptorSetCount = size_of(set_layouts_);
    info.pSetLayouts = set_layouts_.data();
    GOBO_VULKAN_CALL(vkAllocateDescriptorSets, state.device, &info, sets.data());
    std::map<std::pair<int, int>, std::uint32_t> elements;  // of arrays of blocks so far
    for (const Block& block : interface_.blocks) {
        const std::vector<std::byte> bytes = bytes_of(block, resolved.assignments);
        GOBO_TRY(const Buffer buffer,
                 resources_.make_buffer(VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, bytes.data(), bytes.size()));
        const VkDescriptorBufferInfo range{buffer.buffer, 0, VK_WHOLE_SIZE};
        auto write = made<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstSet = sets[static_cast<std::size_t>(block.set)];
        write.dstBinding = static_cast<std::uint32_t>(block.binding);
        write.dstArrayElement = elements[{block.set, block.binding}]++;
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        write.pBufferInfo = &range;
        vk.vkUpdateDescriptorSets(state.device, 1, &write, 0, nullptr);
    }
    for (const Sampler& sampler : interface_.samplers) {
        GOBO_TRY(const VkDescriptorImageInfo image, image_of(sampler, given));
        const std::vector<VkDescriptorImageInfo> images(
            static_cast<std::size_t>(element_count(sampler.array)), image);
        auto write = made<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstSet = sets[static_cast<std::size_t>(sampler.set)];
        write.dstBinding = static_cast<std::uint32_t>(sampler.binding);
        write.descriptorCount = size_of(images);
        write.descriptorType = descriptor_type(sampler);
        write.pImageInfo = images.data();
        vk.vkUpdateDescriptorSets(state.device, 1, &write, 0, nullptr);
    }
    return sets;
}

}  // namespace gobo::vulkan
