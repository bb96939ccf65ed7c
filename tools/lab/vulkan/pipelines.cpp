#include "lab/vulkan/pipelines.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "lab/vulkan/bindings.hpp"
#include "spirv/module.hpp"

namespace gobo::vulkan {
namespace {

bool has_stage(const std::vector<StageModule>& stages, StageKind kind) {
    return std::any_of(stages.begin(), stages.end(),
                       [&](const StageModule& stage) { return stage.kind == kind; });
}

VkPrimitiveTopology topology_of(std::uint32_t mode) {
    switch (mode) {
        case spv::ExecutionModeInputPoints:
            return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
        case spv::ExecutionModeInputLines:
            return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
        case spv::ExecutionModeInputLinesAdjacency:
            return VK_PRIMITIVE_TOPOLOGY_LINE_LIST_WITH_ADJACENCY;
        case spv::ExecutionModeInputTrianglesAdjacency:
            return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST_WITH_ADJACENCY;
        default:
            return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    }
}

/// Whether a comparison's sampler is apart from its texture is seen where it is used: the type is any
/// sampler's.
Result<void> refuse_samplers_that_compare(std::span<const std::uint32_t> words) {
    GOBO_TRY(const spirv::Module module, spirv::read_module(words));
    for (const spirv::Instruction& instruction : module.instructions) {
        const bool compares = instruction.opcode == spv::OpImageSampleDrefImplicitLod ||
                              instruction.opcode == spv::OpImageSampleDrefExplicitLod ||
                              instruction.opcode == spv::OpImageSampleProjDrefImplicitLod ||
                              instruction.opcode == spv::OpImageSampleProjDrefExplicitLod ||
                              instruction.opcode == spv::OpImageDrefGather;
        if (!compares) continue;
        const spirv::Instruction* sampled = module.definition(instruction.id(3));
        if (sampled != nullptr && sampled->opcode == spv::OpSampledImage)
            return fail(module.place(instruction.line), {},
                        "the renderer has no samplerShadow apart from its texture",
                        "declare both as one: a sampler2DShadow");
    }
    return {};
}

/// Patches have as many corners as the tessellation control stage makes.
Result<Primitive> primitive_of(const std::vector<StageModule>& stages) {
    Primitive primitive;
    for (const StageModule& stage : stages) {
        if (stage.kind != StageKind::geometry && stage.kind != StageKind::tess_control) continue;
        GOBO_TRY(const spirv::Module module, spirv::read_module(stage.words));
        for (const spirv::Instruction& instruction : module.instructions) {
            if (instruction.opcode != spv::OpExecutionMode) continue;
            const std::uint32_t mode = instruction.word(2);
            if (stage.kind == StageKind::tess_control) {
                if (mode == spv::ExecutionModeOutputVertices)
                    primitive.corners_of_patch = instruction.word(3);
            } else if (const VkPrimitiveTopology taken = topology_of(mode);
                       taken != VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST) {
                primitive.topology = taken;
            }
        }
    }
    if (has_stage(stages, StageKind::tess_evaluation)) primitive.topology = VK_PRIMITIVE_TOPOLOGY_PATCH_LIST;
    return primitive;
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

}  // namespace

bool Pipelines::draws_triangles() const {
    return primitive_.topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST &&
           !has_stage(stages_, StageKind::geometry);
}

Result<void> Pipelines::make(VkPipelineLayout layout) {
    const Functions& vk = resources_.state().vk;
    layout_ = layout;
    GOBO_TRY(primitive_, primitive_of(stages_));
    constants_.resize(stages_.size());
    for (std::size_t i = 0; i < stages_.size(); ++i) {
        GOBO_TRY_DO(refuse_samplers_that_compare(stages_[i].words));
        Constants& own = constants_[i];
        for (const SpecializedCount& count : stages_[i].specialized) {
            own.entries.push_back(
                {static_cast<std::uint32_t>(count.id), static_cast<std::uint32_t>(4 * own.values.size()), 4});
            own.values.push_back(static_cast<std::uint32_t>(count.value));
        }
        own.info = {size_of(own.entries), own.entries.data(), 4 * own.values.size(), own.values.data()};
        auto info = made<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
        info.codeSize = stages_[i].words.size_bytes();
        info.pCode = stages_[i].words.data();
        auto& stage = infos_.emplace_back(
            made<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO));
        GOBO_TRY(stage.module,
                 resources_.make<VkShaderModule>("vkCreateShaderModule", vk.vkCreateShaderModule,
                                                 vk.vkDestroyShaderModule, info));
        stage.stage = stage_bit(stages_[i].kind);
        stage.pName = "main";
        stage.pSpecializationInfo = &own.info;
    }
    return make_nothing();
}

Result<VkPipeline> Pipelines::of(VkCullModeFlags culled, bool is_blended,
                                 const std::vector<AttributeBuffer>& attributes) {
    std::vector<std::uint32_t> kind = {culled, is_blended ? 1U : 0U};
    for (const AttributeBuffer& attribute : attributes)
        kind.insert(kind.end(),
                    {attribute.location, static_cast<std::uint32_t>(attribute.format), attribute.stride});
    const auto [place, is_new] = known_.try_emplace(std::move(kind), VK_NULL_HANDLE);
    if (is_new) {
        GOBO_TRY(place->second, make_pipeline(culled, is_blended, attributes, infos_));
    }
    return place->second;
}

/// lavapipe of Mesa 22.3.6 dies where uniform buffers are new to a large stage, in which it wants to
/// write their values as constants. A pipeline that draws nothing takes them first.
Result<void> Pipelines::make_nothing() {
    if (resources_.state().name.find("llvmpipe") == std::string::npos) return {};
    const Functions& vk = resources_.state().vk;
    auto info = made<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = sizeof kNothing;
    info.pCode = kNothing.data();
    auto stage = made<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    stage.stage = VK_SHADER_STAGE_VERTEX_BIT;
    stage.pName = "main";
    GOBO_TRY(stage.module, resources_.make<VkShaderModule>("vkCreateShaderModule", vk.vkCreateShaderModule,
                                                           vk.vkDestroyShaderModule, info));
    GOBO_TRY(nothing_, make_pipeline(VK_CULL_MODE_NONE, false, {}, {stage}, true));
    return {};
}

Result<VkPipeline> Pipelines::make_pipeline(VkCullModeFlags culled, bool is_blended,
                                            const std::vector<AttributeBuffer>& given,
                                            const std::vector<VkPipelineShaderStageCreateInfo>& stages,
                                            bool draws_nothing) {
    const Device::State& state = resources_.state();
    const Functions& vk = state.vk;
    std::vector<VkVertexInputBindingDescription> buffers;
    std::vector<VkVertexInputAttributeDescription> attributes;
    for (const AttributeBuffer& attribute : given) {
        const std::uint32_t binding = size_of(buffers);
        buffers.push_back({binding, attribute.stride, VK_VERTEX_INPUT_RATE_VERTEX});
        attributes.push_back({attribute.location, binding, attribute.format, 0});
    }
    auto inputs =
        made<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    inputs.vertexBindingDescriptionCount = size_of(buffers);
    inputs.pVertexBindingDescriptions = buffers.data();
    inputs.vertexAttributeDescriptionCount = size_of(attributes);
    inputs.pVertexAttributeDescriptions = attributes.data();
    auto assembly = made<VkPipelineInputAssemblyStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = draws_nothing ? VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST : primitive_.topology;
    auto tessellation = made<VkPipelineTessellationStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO);
    tessellation.patchControlPoints = primitive_.corners_of_patch;
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
    rasterization.cullMode = culled;
    rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    rasterization.lineWidth = 1;
    rasterization.depthBiasEnable = bias_.slope != 0 || bias_.units != 0 ? VK_TRUE : VK_FALSE;
    rasterization.depthBiasConstantFactor = bias_.units;
    rasterization.depthBiasSlopeFactor = bias_.slope;
    auto samples =
        made<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    auto depth = made<VkPipelineDepthStencilStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = VK_TRUE;
    depth.depthWriteEnable = is_blended ? VK_FALSE : VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_LESS;
    VkPipelineColorBlendAttachmentState all_written{};
    if (writes_color_)
        all_written.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                     VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    if (is_blended) {
        all_written.blendEnable = VK_TRUE;
        all_written.srcColorBlendFactor = all_written.srcAlphaBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
        all_written.dstColorBlendFactor = all_written.dstAlphaBlendFactor =
            VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    }
    auto blending =
        made<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
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
    GOBO_VULKAN_CALL(vkCreateGraphicsPipelines, state.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
    resources_.keep([&state, pipeline] { state.vk.vkDestroyPipeline(state.device, pipeline, nullptr); });
    return pipeline;
}

}  // namespace gobo::vulkan
