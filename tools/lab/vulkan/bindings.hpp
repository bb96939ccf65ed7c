// What the stages of a permutation are bound to: descriptor sets with buffers and textures, push constants.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lab/vulkan/resources.hpp"

namespace gobo::vulkan {

/// VkShaderStageFlagBits: bit by bit in the order of the pipeline, as gobo has the stages.
[[nodiscard]] inline VkShaderStageFlagBits stage_bit(StageKind kind) {
    return static_cast<VkShaderStageFlagBits>(1U << static_cast<unsigned>(kind));
}

class Bindings {
  public:
    Bindings(Resources& resources, const Interface& interface)
        : resources_(resources), interface_(interface) {}

    /// For so many objects. `values` say what textures the renderer has for samplers.
    Result<void> make(std::size_t objects, const std::vector<RenderValue>& values);
    /// The sets of one object, with buffers of its own. Each sampler gets the texture that is given, else
    /// what the renderer has.
    [[nodiscard]] Result<std::vector<VkDescriptorSet>> sets_of(const ResolvedUniforms& resolved,
                                                               const Textures& given);

    [[nodiscard]] VkPipelineLayout layout() const { return layout_; }
    /// The stages that read push constants.
    [[nodiscard]] VkShaderStageFlags push_stages() const { return push_stages_; }

  private:
    Result<void> make_layouts();
    Result<void> make_pool(std::size_t objects);
    Result<VkSampler> make_sampler(const TextureTexels& texels);
    Result<VkDescriptorImageInfo> image_of(const Sampler& sampler, const Textures& given);

    Resources& resources_;
    const Interface& interface_;
    /// By set: those below the highest that bind nothing are there, too.
    std::vector<std::vector<VkDescriptorSetLayoutBinding>> bindings_;
    std::vector<VkDescriptorSetLayout> set_layouts_;
    VkShaderStageFlags push_stages_ = 0;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::map<std::string, Texels> usual_;  ///< what the renderer has for samplers; null where it has nothing
    std::map<Texels, VkSampler> samplers_;
};

}  // namespace gobo::vulkan
