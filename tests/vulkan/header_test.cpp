// A generated header for Vulkan: its tables, and the structs that <gobo/vulkan.hpp> makes of them.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>
#include <vulkan/vulkan_core.h>
// clang-format off: behind Vulkan's own
#include <gobo/vulkan.hpp>
// clang-format on

#include "descriptor_arrays.hpp"
#include "lit.hpp"
#include "pushed_by_stage.hpp"
#include "pushed_sizes.hpp"
#include "resources_by_stage.hpp"
#include "spirv.hpp"

namespace gobo {
namespace {

lit::Key key_of(int point) {
    lit::Key key;
    key.point = point;
    key.fog = lit::Fog::linear;
    return key;
}

TEST(VulkanHeader, SharesModulesBetweenCountsButFor0) {
    const lit::Permutation* one = lit::find(key_of(1));
    const lit::Permutation* three = lit::find(key_of(3));
    const lit::Permutation* none = lit::find(key_of(0));
    ASSERT_TRUE(one != nullptr && three != nullptr && none != nullptr);
    EXPECT_EQ(one->vertex, three->vertex);
    EXPECT_EQ(one->fragment, three->fragment);
    EXPECT_NE(one->fragment, none->fragment);
    EXPECT_EQ(one->fragment.words()[0], 0x07230203u) << "SPIR-V's magic number";
    EXPECT_EQ(one->fragment.size(), 4 * one->fragment.word_count());
    EXPECT_TRUE(one->fragment.exists());
    const VkShaderModuleCreateInfo info = vulkan::module_info(three->fragment);
    EXPECT_EQ(info.sType, VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    EXPECT_EQ(info.pCode, one->fragment.words());
    EXPECT_EQ(info.codeSize, one->fragment.size());
}

TEST(VulkanHeader, SpecializesByTheKey) {
    const lit::Permutation* three = lit::find(key_of(3));
    ASSERT_EQ(lit::specialization_constants.size(), 1u);
    EXPECT_EQ(lit::specialization_constants[0].name, "POINT_LIGHTS");
    EXPECT_EQ(lit::specialization_constants[0].type, "int");
    EXPECT_EQ(lit::specialization_constants[0].value, 8u) << "the most that the family has";
    const vulkan::Specialization specialization(*three);
    const VkSpecializationInfo& info = *specialization.info();
    ASSERT_EQ(info.mapEntryCount, 1u);
    EXPECT_EQ(info.pMapEntries[0].constantID, lit::specialization_constants[0].id);
    EXPECT_EQ(info.pMapEntries[0].size, 4u);
    EXPECT_EQ(static_cast<const std::uint32_t*>(info.pData)[info.pMapEntries[0].offset / 4], 3u);
    const VkPipelineShaderStageCreateInfo stage =
        vulkan::stage_info(runtime::StageKind::fragment, VK_NULL_HANDLE, &info);
    EXPECT_EQ(stage.stage, VK_SHADER_STAGE_FRAGMENT_BIT);
    EXPECT_STREQ(stage.pName, "main");
    EXPECT_EQ(vulkan::stage_info(runtime::StageKind::compute, VK_NULL_HANDLE).stage,
              VK_SHADER_STAGE_COMPUTE_BIT);
}

TEST(VulkanHeader, LaysSetsOutAsTheFamilySays) {
    EXPECT_EQ(lit::descriptor_set::frame, 0u);
    EXPECT_EQ(lit::descriptor_set::object, 2u);
    EXPECT_EQ(vulkan::set_count(lit::descriptors), 3u);
    EXPECT_EQ(lit::PointLights::set, 0);
    EXPECT_EQ(lit::PointLights::binding, 1);
    const auto frame = vulkan::layout_bindings(lit::descriptors, lit::descriptor_set::frame);
    ASSERT_EQ(frame.size(), 3u) << "lights, ambient light, fog";
    EXPECT_EQ(frame[0].binding, 1u);
    EXPECT_EQ(frame[0].descriptorType, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    EXPECT_EQ(frame[0].descriptorCount, 1u);
    EXPECT_EQ(frame[0].stageFlags, static_cast<VkShaderStageFlags>(VK_SHADER_STAGE_FRAGMENT_BIT));
    const auto object =
        vulkan::layout_bindings(lit::descriptors, lit::descriptor_set::object, *lit::find(key_of(0)));
    ASSERT_EQ(object.size(), 1u);
    EXPECT_EQ(object[0].stageFlags, static_cast<VkShaderStageFlags>(VK_SHADER_STAGE_VERTEX_BIT));
    EXPECT_TRUE(vulkan::push_constant_ranges(lit::push_constants).empty());
    const VkDescriptorBufferInfo buffer{};
    const VkWriteDescriptorSet write = vulkan::write_block<lit::PointLights>(VK_NULL_HANDLE, buffer);
    EXPECT_EQ(write.dstBinding, 1u);
    EXPECT_EQ(write.pBufferInfo, &buffer);
}

TEST(VulkanHeader, GivesArraysOneBindingAndKnowsEveryKind) {
    struct Row {
        std::string_view name;
        std::uint32_t set, binding, count;
        VkDescriptorType type;
        bool operator==(const Row&) const = default;
    };
    std::vector<Row> rows;
    for (std::uint32_t set = 0; set < vulkan::set_count(descriptor_arrays::descriptors); ++set) {
        const auto bindings = vulkan::layout_bindings(descriptor_arrays::descriptors, set);
        for (const runtime::Descriptor& descriptor : descriptor_arrays::descriptors)
            for (const VkDescriptorSetLayoutBinding& binding : bindings)
                if (descriptor.set == set && descriptor.binding == binding.binding)
                    rows.push_back({descriptor.name, set, binding.binding, binding.descriptorCount,
                                    binding.descriptorType});
    }
    EXPECT_EQ(rows, (std::vector<Row>{{"Records", 0, 0, 3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                      {"Tints", 0, 1, 4, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
                                      {"Scales", 1, 0, 2, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
                                      {"Bias", 1, 1, 1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
                                      {"maps", 2, 0, 5, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                                      {"plain", 2, 1, 1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
                                      {"filtering", 2, 2, 1, VK_DESCRIPTOR_TYPE_SAMPLER},
                                      {"grid", 2, 3, 1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
                                      {"row", 2, 4, 1, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
                                      {"noise", 2, 5, 1, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER},
                                      {"drawn", 2, 6, 1, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT}}));
    const auto ranges = vulkan::push_constant_ranges(descriptor_arrays::push_constants);
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].stageFlags, static_cast<VkShaderStageFlags>(VK_SHADER_STAGE_FRAGMENT_BIT));
    EXPECT_EQ(ranges[0].offset, 0u);
    EXPECT_EQ(ranges[0].size, sizeof(descriptor_arrays::Pushed));
    EXPECT_EQ(descriptor_arrays::Records::binding, 0);
    EXPECT_EQ(descriptor_arrays::Tints::binding, 1);
    EXPECT_EQ(descriptor_arrays::Scales::binding, 0);
}

struct PushConstantsRow {
    const char* name;
    std::vector<runtime::PushConstants> blocks;
    std::vector<std::array<std::uint32_t, 3>> ranges;  ///< stages, offset and bytes
};

/// No stage is in two ranges (VUID-VkPipelineLayoutCreateInfo-pPushConstantRanges-00292).
class PushConstantRanges : public testing::TestWithParam<PushConstantsRow> {};

TEST_P(PushConstantRanges, HaveEachStageOnce) {
    std::vector<std::array<std::uint32_t, 3>> ranges;
    for (const VkPushConstantRange& range : vulkan::push_constant_ranges(GetParam().blocks))
        ranges.push_back({range.stageFlags, range.offset, range.size});
    EXPECT_EQ(ranges, GetParam().ranges);
}

constexpr std::uint32_t kVertex = VK_SHADER_STAGE_VERTEX_BIT;
constexpr std::uint32_t kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
INSTANTIATE_TEST_SUITE_P(
    Rows, PushConstantRanges,
    testing::Values(
        PushConstantsRow{"none", {}, {}},
        PushConstantsRow{
            "of_two_stages", {{"Tint", 16, kVertex | kFragment}}, {{kVertex | kFragment, 0, 16}}},
        PushConstantsRow{"of_keys", {{"Tint", 16, kFragment}, {"Tone", 32, kFragment}}, {{kFragment, 0, 32}}},
        PushConstantsRow{"of_keys_and_stages",
                         {{"Tint", 16, kVertex | kFragment}, {"Tone", 32, kFragment}},
                         {{kVertex, 0, 16}, {kFragment, 0, 32}}},
        PushConstantsRow{"behind_each_other",
                         {pushed_by_stage::push_constants.begin(), pushed_by_stage::push_constants.end()},
                         {{kVertex, 0, 16}, {kFragment, 16, 16}}},
        PushConstantsRow{"of_keys_behind_another_stage",
                         {{"Tint", 32, kFragment, 16}, {"Tone", 80, kFragment, 64}, {"Place", 64, kVertex}},
                         {{kVertex, 0, 64}, {kFragment, 16, 64}}}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(VulkanHeader, HasAStructForEachBlockOfOneName) {
    namespace here = resources_by_stage;
    static_assert(here::Values::binding == 1 && here::Values_2::binding == 2);
    static_assert(offsetof(here::Values, shift) == 0 && offsetof(here::Values_2, tint) == 16);
    static_assert(here::sampler::map.binding == 0 && here::sampler::map_2.binding == 1);
    const VkDescriptorBufferInfo buffer{};
    EXPECT_EQ(vulkan::write_block<here::Values_2>(VK_NULL_HANDLE, buffer).dstBinding, 2u);
    const auto layout = vulkan::layout_bindings(here::descriptors, 0);
    ASSERT_EQ(layout.size(), 3u);
    EXPECT_EQ(layout[1].stageFlags, static_cast<VkShaderStageFlags>(VK_SHADER_STAGE_VERTEX_BIT));
    EXPECT_EQ(layout[2].stageFlags, static_cast<VkShaderStageFlags>(VK_SHADER_STAGE_FRAGMENT_BIT));
}

struct PushedSizeRow {
    const char* name;
    std::size_t of_struct, stated, bytes;
};

/// vkCmdPushConstants() reads as many bytes as the range has.
class PushedSizes : public testing::TestWithParam<PushedSizeRow> {};

TEST_P(PushedSizes, AreThoseOfTheStructs) {
    const PushedSizeRow& row = GetParam();
    const auto block = std::find_if(
        pushed_sizes::push_constants.begin(), pushed_sizes::push_constants.end(),
        [&](const runtime::PushConstants& one) { return one.name == std::string_view(row.name); });
    ASSERT_NE(block, pushed_sizes::push_constants.end());
    EXPECT_EQ(block->size, row.bytes);
    EXPECT_EQ(row.of_struct, row.bytes);
    EXPECT_EQ(row.stated, row.bytes);
}

#define SIZES(block, bytes)                                                   \
    PushedSizeRow {                                                           \
#block, sizeof(pushed_sizes::block), pushed_sizes::block::size, bytes \
    }
INSTANTIATE_TEST_SUITE_P(Rows, PushedSizes,
                         testing::Values(SIZES(BehindOthers, 8), SIZES(OneStruct, 4), SIZES(FarApart, 124),
                                         SIZES(EndsInVector, 32), SIZES(Rows, 32), SIZES(Doubles, 16),
                                         SIZES(Rays, 80), SIZES(Std140, 64), SIZES(Whole, 128)),
                         [](const auto& row) { return std::string(row.param.name); });
#undef SIZES

struct Vertex {
    float weight;
    glm::vec3 position;
    glm::vec3 normal;
};

TEST(VulkanHeader, DescribesVertices) {
    const auto normal = vulkan::vertex_attributes(lit::attribute::normal, &Vertex::normal, 2);
    ASSERT_EQ(normal.size(), 1u);
    EXPECT_EQ(normal[0].location, 1u);
    EXPECT_EQ(normal[0].binding, 2u);
    EXPECT_EQ(normal[0].format, VK_FORMAT_R32G32B32_SFLOAT);
    EXPECT_EQ(normal[0].offset, 16u);
    ASSERT_EQ(lit::vertex_inputs.size(), 2u);
    EXPECT_EQ(lit::vertex_inputs[0].format, static_cast<std::uint32_t>(VK_FORMAT_R32G32B32_SFLOAT));
    EXPECT_EQ(vulkan::detail::format_of<std::int32_t>(1), VK_FORMAT_R32_SINT);
    EXPECT_EQ(vulkan::detail::format_of<std::uint32_t>(2), VK_FORMAT_R32G32_UINT);
    EXPECT_EQ(vulkan::detail::format_of<double>(4), VK_FORMAT_R64G64B64A64_SFLOAT);
}

/// A column of three doubles takes two locations.
TEST(VulkanHeader, GivesColumnsOfDoublesTwoLocations) {
    struct Precise {
        glm::dmat3 turn;
    };
    std::vector<std::uint32_t> described;
    for (const VkVertexInputAttributeDescription& attribute :
         vulkan::vertex_attributes(descriptor_arrays::attribute::turn, &Precise::turn))
        described.push_back(attribute.location);
    EXPECT_EQ(described, (std::vector<std::uint32_t>{1, 3, 5}));
    std::vector<std::uint32_t> listed;
    for (const runtime::VertexInput& input : descriptor_arrays::vertex_inputs)
        if (input.name == "turn") listed.push_back(input.location);
    EXPECT_EQ(listed, described);
}

/// The header for OpenGL 4.6 has no sets, and the bindings and units of the texts for 4.5.
TEST(OpenGlSpirvHeader, HoldsModules) {
    const spirv::Permutation* found = spirv::find(spirv::Key{});
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->vertex.words()[0], 0x07230203u);
    EXPECT_TRUE(spirv::descriptors.empty());
    EXPECT_EQ(spirv::Transform::binding, 0);
}

}  // namespace
}  // namespace gobo
