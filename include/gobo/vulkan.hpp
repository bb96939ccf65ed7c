// Vulkan's structs from the plain tables of a generated header, for whoever has included <vulkan/vulkan.h>.
// No function of Vulkan is called, so any loader will do.
//
//     #include <vulkan/vulkan.h>
//     #include <gobo/vulkan.hpp>
//     #include "lit.hpp"                                        // gobo build lit --dialect vulkan
//
//     const auto bindings = gobo::vulkan::layout_bindings(lit::descriptors, lit::descriptor_set::frame);
//     const VkShaderModuleCreateInfo module = gobo::vulkan::module_info(p->vertex);
//     const gobo::vulkan::Specialization counts(*p);            // the key's counts; keep it until the
//     pipeline is made const auto stage = gobo::vulkan::stage_info(gobo::runtime::StageKind::vertex, handle,
//     counts.info());
#pragma once

#ifndef VULKAN_CORE_H_
#error "include <vulkan/vulkan.h> before <gobo/vulkan.hpp>"
#endif

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <gobo/spirv.hpp>
#include <gobo/uniform.hpp>

namespace gobo::vulkan {

/// How many descriptor sets the table names: one more than the highest.
template <class Descriptors>
[[nodiscard]] constexpr std::uint32_t set_count(const Descriptors& descriptors) {
    std::uint32_t count = 0;
    for (const runtime::Descriptor& descriptor : descriptors)
        if (descriptor.set >= count) count = descriptor.set + 1;
    return count;
}

namespace detail {

template <class Descriptors, class IsMeant>
std::vector<VkDescriptorSetLayoutBinding> layout_bindings(const Descriptors& descriptors, std::uint32_t set,
                                                          IsMeant is_meant) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const runtime::Descriptor& descriptor : descriptors) {
        if (descriptor.set != set || !is_meant(descriptor)) continue;
        if (!bindings.empty() && bindings.back().binding == descriptor.binding) {  // declared in several ways
            VkDescriptorSetLayoutBinding& other = bindings.back();
            if (other.descriptorCount < descriptor.count) other.descriptorCount = descriptor.count;
            other.stageFlags |= descriptor.stages;
            continue;
        }
        VkDescriptorSetLayoutBinding binding{};
        binding.binding = descriptor.binding;
        binding.descriptorType = static_cast<VkDescriptorType>(descriptor.kind);
        binding.descriptorCount = descriptor.count;
        binding.stageFlags = descriptor.stages;
        bindings.push_back(binding);
    }
    return bindings;
}

}  // namespace detail

/// For vkCreateDescriptorSetLayout: what one set holds in all permutations together. With layouts made of
/// these, a set that is bound once serves every pipeline of the family.
template <class Descriptors>
[[nodiscard]] std::vector<VkDescriptorSetLayoutBinding> layout_bindings(const Descriptors& descriptors,
                                                                        std::uint32_t set) {
    return detail::layout_bindings(descriptors, set, [](const runtime::Descriptor&) { return true; });
}

/// The same as one permutation declares it, where others declare it differently.
template <class Descriptors, class Permutation>
[[nodiscard]] std::vector<VkDescriptorSetLayoutBinding> layout_bindings(const Descriptors& descriptors,
                                                                        std::uint32_t set,
                                                                        const Permutation& permutation) {
    return detail::layout_bindings(descriptors, set, [&](const runtime::Descriptor& descriptor) {
        return descriptor.only.applies_to(permutation);
    });
}

/// For vkCreatePipelineLayout. Vulkan allows a stage one range, so of a stage with several blocks, those of
/// other keys, it holds all of them; stages with the same bytes share one.
template <class PushConstants>
[[nodiscard]] std::vector<VkPushConstantRange> push_constant_ranges(const PushConstants& push_constants) {
    std::vector<VkPushConstantRange> ranges;
    for (std::uint32_t stage = 1; stage != 0; stage <<= 1U) {
        std::uint32_t begin = ~0U;
        std::uint32_t end = 0;
        for (const runtime::PushConstants& block : push_constants) {
            if ((block.stages & stage) == 0) continue;
            begin = block.offset < begin ? block.offset : begin;
            end = block.size > end ? block.size : end;
        }
        if (begin >= end) continue;
        VkPushConstantRange range{};
        range.stageFlags = stage;
        range.offset = begin;
        range.size = end - begin;
        bool is_new = true;
        for (VkPushConstantRange& other : ranges)
            if (other.offset == range.offset && other.size == range.size) {
                other.stageFlags |= stage;
                is_new = false;
            }
        if (is_new) ranges.push_back(range);
    }
    return ranges;
}

/// For vkCreateShaderModule. Points into the header's constants.
template <class Tables>
[[nodiscard]] VkShaderModuleCreateInfo module_info(const runtime::SpirvStage<Tables>& stage) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = stage.size();
    info.pCode = stage.words();
    return info;
}

/// Chooses the specialisation constants for a permutation, such as its counts of lights. info() points into
/// it.
template <class Permutation>
class Specialization {
  public:
    explicit Specialization(const Permutation& permutation) : values_(permutation.specialization()) {
        std::uint32_t offset = 0;
        for (std::size_t i = 0; i < values_.size(); ++i, offset += sizeof(std::uint32_t))
            entries_[i] = {Permutation::Tables::specialization_constants[i].id, offset,
                           sizeof(std::uint32_t)};
        info_.mapEntryCount = static_cast<std::uint32_t>(values_.size());
        info_.pMapEntries = entries_.data();
        info_.dataSize = values_.size() * sizeof(std::uint32_t);
        info_.pData = values_.data();
    }
    Specialization(const Specialization&) = delete;
    Specialization& operator=(const Specialization&) = delete;

    [[nodiscard]] const VkSpecializationInfo* info() const { return &info_; }

  private:
    static constexpr std::size_t kCount = Permutation::Tables::specialization_constants.size();
    std::array<std::uint32_t, kCount> values_;
    std::array<VkSpecializationMapEntry, kCount> entries_{};
    VkSpecializationInfo info_{};
};

/// A stage of a pipeline, for vkCreateGraphicsPipelines or vkCreateComputePipelines.
[[nodiscard]] inline VkPipelineShaderStageCreateInfo stage_info(
    runtime::StageKind kind, VkShaderModule module, const VkSpecializationInfo* specialization = nullptr) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = static_cast<VkShaderStageFlagBits>(1U << static_cast<unsigned>(kind));
    info.module = module;
    info.pName = "main";
    info.pSpecializationInfo = specialization;
    return info;
}

namespace detail {

/// VkFormat of up to four numbers.
template <class Number>
constexpr VkFormat format_of(int rows) {
    static_assert(std::is_same_v<Number, float> || std::is_same_v<Number, std::int32_t> ||
                      std::is_same_v<Number, std::uint32_t> || std::is_same_v<Number, double>,
                  "no vertex attribute is made of these numbers");
    const int first = std::is_same_v<Number, double>         ? VK_FORMAT_R64_SFLOAT
                      : std::is_same_v<Number, float>        ? VK_FORMAT_R32_SFLOAT
                      : std::is_same_v<Number, std::int32_t> ? VK_FORMAT_R32_SINT
                                                             : VK_FORMAT_R32_UINT;
    return static_cast<VkFormat>(first + 3 * (rows - 1));
}

template <class Member>
struct VertexMember : runtime::NumbersOf<Member> {
    using Value = Member;
    static constexpr int count = 1;
};
template <class Element, std::size_t Extent>
struct VertexMember<Element[Extent]> : runtime::NumbersOf<Element> {
    using Value = Element;
    static constexpr int count = static_cast<int>(Extent);
};

}  // namespace detail

/// Reads an attribute from a member of the vertices of a buffer bound at `binding`: one description for each
/// column of a matrix and element of an array, two locations apart where that is of three or four doubles.
/// The member is of the attribute's type (GLM's in any layout), of an array attribute an array of as many
/// elements or fewer; else it does not compile.
template <class Value, int Extent, class Vertex, class Member>
[[nodiscard]] auto vertex_attributes(AttributePlace<Value, Extent> attribute, Member Vertex::*member,
                                     std::uint32_t binding = 0) {
    using Given = detail::VertexMember<Member>;
    static_assert(runtime::TakesValue<Value, typename Given::Value>::value,
                  "the attribute is of another type");
    static_assert(Given::count <= Extent, "the attribute's array is shorter");
    constexpr int columns = Given::count * Given::columns;
    constexpr std::size_t column_size =
        sizeof(Member) / static_cast<std::size_t>(columns);  // with its padding
    const Vertex vertex{};
    const auto* const begin = reinterpret_cast<const char*>(&vertex);
    auto offset = static_cast<std::uint32_t>(reinterpret_cast<const char*>(&(vertex.*member)) - begin);
    std::array<VkVertexInputAttributeDescription, static_cast<std::size_t>(columns)> descriptions{};
    auto location = static_cast<std::uint32_t>(attribute.location);
    constexpr bool is_wide = Given::rows * sizeof(typename Given::Number) > 16;
    for (VkVertexInputAttributeDescription& description : descriptions) {
        description = {location, binding, detail::format_of<typename Given::Number>(Given::rows), offset};
        location += is_wide ? 2 : 1;
        offset += static_cast<std::uint32_t>(column_size);
    }
    return descriptions;
}

/// For vkUpdateDescriptorSets: binds a buffer as the block `Block` of the header. Points at `buffer`.
template <class Block>
[[nodiscard]] VkWriteDescriptorSet write_block(VkDescriptorSet set, const VkDescriptorBufferInfo& buffer,
                                               VkDescriptorType type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = static_cast<std::uint32_t>(Block::binding);
    write.descriptorCount = 1;
    write.descriptorType = type;
    write.pBufferInfo = &buffer;
    return write;
}

/// The same for a sampler of the header. Points at `image`.
[[nodiscard]] inline VkWriteDescriptorSet write_sampler(VkDescriptorSet set, DescriptorPlace sampler,
                                                        const VkDescriptorImageInfo& image) {
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = static_cast<std::uint32_t>(sampler.binding);
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image;
    return write;
}

}  // namespace gobo::vulkan
