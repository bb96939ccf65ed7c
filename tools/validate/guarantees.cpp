#include "validate/guarantees.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace gobo {
namespace {

/// Vulkan 1.0, table 53. Of OpenGL's constants that name a stage, what stands behind it.
struct VulkanLimit {
    std::string_view constant;
    std::string_view name;
    int least;
};
constexpr std::array<VulkanLimit, 14> kVulkanLimits = {{
    {"MAX_VERTEX_ATTRIBS", "maxVertexInputAttributes", 16},
    {"MAX_DRAW_BUFFERS", "maxFragmentOutputAttachments", 4},
    {"_UNIFORM_BLOCKS", "maxPerStageDescriptorUniformBuffers", 12},
    {"MAX_TEXTURE_IMAGE_UNITS", "maxPerStageDescriptorSamplers", 16},
    {"MAX_UNIFORM_BLOCK_SIZE", "maxUniformBufferRange", 16384},
    {"MAX_VARYING_COMPONENTS", "maxFragmentInputComponents", 64},
    {"MAX_VARYING_COMPONENTS / 4", "maxFragmentInputComponents / 4", 16},
    {"MAX_VARYING_VECTORS", "maxFragmentInputComponents / 4", 16},
    {"MAX_GEOMETRY_SHADER_INVOCATIONS", "maxGeometryShaderInvocations", 32},
    {"MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS", "maxGeometryTotalOutputComponents", 1024},
    {"MAX_SAMPLE_MASK_WORDS", "maxSampleMaskWords", 1},
    {"MAX_PATCH_VERTICES", "maxTessellationPatchSize", 32},
    {"MAX_COMPUTE_WORK_GROUP_INVOCATIONS", "maxComputeWorkGroupInvocations", 128},
    {"MAX_COMPUTE_SHARED_MEMORY_SIZE", "maxComputeSharedMemorySize", 16384},
}};

const VulkanLimit* vulkan_limit(std::string_view constant) {
    const auto* const found = std::ranges::find_if(kVulkanLimits, [&](const VulkanLimit& row) {
        return row.constant.starts_with('_') ? constant.ends_with(row.constant) : constant == row.constant;
    });
    return found == kVulkanLimits.end() ? nullptr : found;
}

}  // namespace

std::int64_t guaranteed(Dialect dialect, std::int64_t limit, std::string_view constant) {
    const VulkanLimit* const found = dialect == Dialect::vulkan ? vulkan_limit(constant) : nullptr;
    return found == nullptr ? limit : std::min<std::int64_t>(limit, found->least);
}

std::string guarantee_text(Dialect dialect, std::int64_t size, std::int64_t limit,
                           std::string_view constant) {
    if (dialect != Dialect::vulkan) return fmt::format("OpenGL guarantees only {} ({})", limit, constant);
    const VulkanLimit* const found = vulkan_limit(constant);
    if (found == nullptr) return fmt::format("gobo takes only {}", limit);
    if (size > limit && found->least < limit)
        return fmt::format("gobo takes only {}, Vulkan guarantees {} ({})", limit, found->least, found->name);
    return fmt::format("Vulkan guarantees only {} ({})", found->least, found->name);
}

}  // namespace gobo
