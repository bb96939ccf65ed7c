// The pipelines of a permutation: one for each way in which objects are culled, are
// blended and bring their attributes.
#pragma once

#include <map>
#include <vector>

#include "lab/vulkan/resources.hpp"
#include "lab/vulkan/target.hpp"

namespace gobo::vulkan {

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

/// As what the corners of a mesh's triangles are drawn: in their order, as many at a time as it takes.
struct Primitive {
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    std::uint32_t corners_of_patch = 3;
};

class Pipelines {
  public:
    Pipelines(Resources& resources, const std::vector<StageModule>& stages, const Target& target,
              DepthBias bias, bool writes_color)
        : resources_(resources), stages_(stages), target_(target), bias_(bias), writes_color_(writes_color) {}

    Result<void> make(VkPipelineLayout layout);
    /// The pipeline for an object; made where none is alike.
    [[nodiscard]] Result<VkPipeline> of(VkCullModeFlags culled, bool is_blended,
                                        const std::vector<AttributeBuffer>& attributes);
    /// A pipeline that draws nothing, to be drawn by before each object; none where it is not needed.
    [[nodiscard]] VkPipeline nothing() const { return nothing_; }
    /// Whether triangles reach the rasteriser as meshes have them.
    [[nodiscard]] bool draws_triangles() const;

  private:
    Result<void> make_nothing();
    Result<VkPipeline> make_pipeline(VkCullModeFlags culled, bool is_blended,
                                     const std::vector<AttributeBuffer>& attributes,
                                     const std::vector<VkPipelineShaderStageCreateInfo>& stages,
                                     bool draws_nothing = false);

    /// The values of a stage's specialisation constants, which stay where they are until there is a pipeline.
    struct Constants {
        std::vector<std::uint32_t> values;
        std::vector<VkSpecializationMapEntry> entries;
        VkSpecializationInfo info{};
    };

    Resources& resources_;
    const std::vector<StageModule>& stages_;
    const Target& target_;
    DepthBias bias_;
    bool writes_color_;  ///< else the target's colour stays
    Primitive primitive_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    std::vector<Constants> constants_;
    std::vector<VkPipelineShaderStageCreateInfo> infos_;
    std::map<std::vector<std::uint32_t>, VkPipeline> known_;
    VkPipeline nothing_ = VK_NULL_HANDLE;
};

}  // namespace gobo::vulkan
