#include "lab/cost/driver.hpp"

#define VK_NO_PROTOTYPES
#include <dlfcn.h>
#include <fmt/format.h>
#include <vulkan/vulkan_core.h>

namespace gobo::cost {
namespace {

tl::unexpected<Diagnostics> fail_call(const char* name, VkResult result) {
    return fail(Fault::input, fmt::format("answered {} with {}", name, static_cast<int>(result)));
}

/// Calls a function of `vk` that may fail, within a function of a Result.
#define GOBO_VULKAN(function, ...)                                                            \
    if (const VkResult vulkan_result = vk.function(__VA_ARGS__); vulkan_result != VK_SUCCESS) \
    return fail_call(#function, vulkan_result)

/// The functions of Vulkan that are called.
#define GOBO_INSTANCE_FUNCTIONS(DO)    \
    DO(vkEnumeratePhysicalDevices)     \
    DO(vkGetPhysicalDeviceProperties2) \
    DO(vkGetPhysicalDeviceFeatures2) DO(vkCreateDevice) DO(vkGetDeviceProcAddr)
#define GOBO_DEVICE_FUNCTIONS(DO)            \
    DO(vkCreateShaderModule)                 \
    DO(vkDestroyShaderModule)                \
    DO(vkCreateDescriptorSetLayout)          \
    DO(vkDestroyDescriptorSetLayout)         \
    DO(vkCreatePipelineLayout)               \
    DO(vkDestroyPipelineLayout)              \
    DO(vkCreateGraphicsPipelines)            \
    DO(vkCreateComputePipelines)             \
    DO(vkDestroyPipeline)                    \
    DO(vkGetPipelineExecutablePropertiesKHR) \
    DO(vkGetPipelineExecutableStatisticsKHR) DO(vkGetPipelineExecutableInternalRepresentationsKHR)
#define GOBO_DECLARE(function) PFN_##function function = nullptr;
struct Functions {
    PFN_vkCreateInstance vkCreateInstance = nullptr;
    GOBO_INSTANCE_FUNCTIONS(GOBO_DECLARE)
    GOBO_DEVICE_FUNCTIONS(GOBO_DECLARE)
};

VkDescriptorType type_of(Descriptor::Kind kind) {
    switch (kind) {
        case Descriptor::Kind::uniform_buffer:
            return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        case Descriptor::Kind::storage_buffer:
            return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        case Descriptor::Kind::texture:
            return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        case Descriptor::Kind::texel_buffer:
            return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
        case Descriptor::Kind::image:
            return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        case Descriptor::Kind::image_buffer:
            return VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
        case Descriptor::Kind::bare_texture:
            return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        case Descriptor::Kind::sampler:
            return VK_DESCRIPTOR_TYPE_SAMPLER;
        case Descriptor::Kind::input_attachment:
            return VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
    }
    return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
}

/// Of components of 32 bits, from 1 to 4.
VkFormat format_of(Scalar scalar, int components) {
    constexpr VkFormat kFormats[3][4] = {
        {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32_SFLOAT,
         VK_FORMAT_R32G32B32A32_SFLOAT},
        {VK_FORMAT_R32_SINT, VK_FORMAT_R32G32_SINT, VK_FORMAT_R32G32B32_SINT, VK_FORMAT_R32G32B32A32_SINT},
        {VK_FORMAT_R32_UINT, VK_FORMAT_R32G32_UINT, VK_FORMAT_R32G32B32_UINT, VK_FORMAT_R32G32B32A32_UINT}};
    const int kind = scalar == Scalar::int32 ? 1 : scalar == Scalar::uint32 ? 2 : 0;
    return kFormats[kind][components - 1];
}

/// What fragments are written to: 16-bit floats, as renderers of linear light have.
VkFormat target_of(const std::optional<Scalar>& output) {
    if (!output) return VK_FORMAT_UNDEFINED;
    return is_integer(*output) ? format_of(*output, 4) : VK_FORMAT_R16G16B16A16_SFLOAT;
}

std::uint64_t value_of(const VkPipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
            return statistic.value.b32;
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR:
            return static_cast<std::uint64_t>(statistic.value.f64);
        default:
            return statistic.value.u64;
    }
}

/// A struct of Vulkan's with its type, all else 0.
template <class Struct>
Struct made(VkStructureType type, void* next = nullptr) {
    Struct value{};
    value.sType = type;
    value.pNext = next;
    return value;
}

template <class Item>
std::uint32_t size_of(const std::vector<Item>& list) {
    return static_cast<std::uint32_t>(list.size());
}

using StageInfos = std::vector<VkPipelineShaderStageCreateInfo>;

constexpr VkPipelineCreateFlags kCaptured = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR |
                                            VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR;

VkShaderStageFlagBits bit_of(StageKind kind) {
    return static_cast<VkShaderStageFlagBits>(1U << static_cast<unsigned>(kind));  // the pipeline's order
}

}  // namespace

struct Driver::Device {
    Functions vk;
    VkDevice device = nullptr;
    std::string name;

    [[nodiscard]] Result<VkShaderModule> module_of(const Words& words) const;
    [[nodiscard]] Result<VkPipeline> graphics_of(const Pipeline& pipeline, const StageInfos& stages,
                                                 VkPipelineLayout layout) const;
    [[nodiscard]] Result<VkPipeline> compute_of(const VkPipelineShaderStageCreateInfo& stage,
                                                VkPipelineLayout layout) const;
    [[nodiscard]] Result<std::vector<CompiledStage>> stages_of(VkPipeline pipeline) const;
    [[nodiscard]] Result<std::string> assembly_of(const VkPipelineExecutableInfoKHR& executable) const;
};

Result<Driver> Driver::open(const std::string& library) {
    void* loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (loaded == nullptr) {
        const std::string reason = dlerror();
        const bool lacks_libc = reason.find("GLIBC") != std::string::npos;
        return fail(
            Fault::file, fmt::format("cannot load the Vulkan driver: {}", reason),
            lacks_libc ? "name the folder with its C library instead, as tools/fetch_mesa.sh makes it" : "");
    }
    const auto entry = [&](const char* name) { return dlsym(loaded, name); };
    const auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(entry("vk_icdGetInstanceProcAddr"));
    if (get == nullptr)
        return fail(Fault::file,
                    fmt::format("{} is no Vulkan driver: it has no vk_icdGetInstanceProcAddr", library));
    using Negotiate = VkResult (*)(std::uint32_t*);
    if (const auto negotiate =
            reinterpret_cast<Negotiate>(entry("vk_icdNegotiateLoaderICDInterfaceVersion"))) {
        std::uint32_t version = 5;
        negotiate(&version);
    }
    auto device = std::make_shared<Device>();
    Functions& vk = device->vk;
    vk.vkCreateInstance = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
    auto application = made<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "gobo";
    application.apiVersion = VK_API_VERSION_1_3;
    auto instance_info = made<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    instance_info.pApplicationInfo = &application;
    VkInstance instance = nullptr;
    GOBO_VULKAN(vkCreateInstance, &instance_info, nullptr, &instance);
#define GOBO_LOAD(function) vk.function = reinterpret_cast<PFN_##function>(get(instance, #function));
    GOBO_INSTANCE_FUNCTIONS(GOBO_LOAD)
#undef GOBO_LOAD
    std::uint32_t count = 1;
    VkPhysicalDevice gpu = nullptr;
    if (const VkResult result = vk.vkEnumeratePhysicalDevices(instance, &count, &gpu);
        (result != VK_SUCCESS && result != VK_INCOMPLETE) || count == 0)
        return fail(Fault::file, fmt::format("{} has no device", library),
                    "'gobo cost --gpu list' says of which chips this driver has figures");
    auto driver = made<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto properties =
        made<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver);
    vk.vkGetPhysicalDeviceProperties2(gpu, &properties);
    device->name = fmt::format("{} {}", driver.driverName, driver.driverInfo);

    // Everything that a shader may ask for, but no checks of buffers' bounds: they would be in every figure.
    auto executables = made<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR);
    auto features13 = made<VkPhysicalDeviceVulkan13Features>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, &executables);
    auto features12 = made<VkPhysicalDeviceVulkan12Features>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &features13);
    auto features11 = made<VkPhysicalDeviceVulkan11Features>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, &features12);
    auto features =
        made<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features11);
    vk.vkGetPhysicalDeviceFeatures2(gpu, &features);
    features.features.robustBufferAccess = VK_FALSE;
    features13.robustImageAccess = VK_FALSE;
    if (executables.pipelineExecutableInfo == VK_FALSE)
        return fail(
            Fault::file,
            fmt::format(
                "{} tells nothing of compiled shaders: it lacks VK_KHR_pipeline_executable_properties",
                device->name),
            "name Mesa's RADV or NVK: libvulkan_radeon.so, libvulkan_nouveau.so");
    const float priority = 1;
    auto queue = made<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const char* extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    auto device_info = made<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features);
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue;
    device_info.enabledExtensionCount = 1;
    device_info.ppEnabledExtensionNames = &extension;
    GOBO_VULKAN(vkCreateDevice, gpu, &device_info, nullptr, &device->device);
#define GOBO_LOAD(function) \
    vk.function = reinterpret_cast<PFN_##function>(vk.vkGetDeviceProcAddr(device->device, #function));
    GOBO_DEVICE_FUNCTIONS(GOBO_LOAD)
#undef GOBO_LOAD
    return Driver(device);
}

const std::string& Driver::name() const {
    return device_->name;
}

Result<VkShaderModule> Driver::Device::module_of(const Words& words) const {
    auto info = made<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = words.size() * sizeof(words[0]);
    info.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    GOBO_VULKAN(vkCreateShaderModule, device, &info, nullptr, &module);
    return module;
}

/// Triangles from one buffer, drawn to as many targets as the fragment stage writes, with a depth buffer.
Result<VkPipeline> Driver::Device::graphics_of(const Pipeline& pipeline, const StageInfos& stages,
                                               VkPipelineLayout layout) const {
    std::vector<VkVertexInputAttributeDescription> attributes;
    VkVertexInputBindingDescription buffer{0, 0, VK_VERTEX_INPUT_RATE_VERTEX};
    for (const VertexInput& input : pipeline.inputs) {
        attributes.push_back({input.location, 0, format_of(input.scalar, input.components), buffer.stride});
        buffer.stride += 4 * static_cast<std::uint32_t>(input.components);
    }
    auto inputs =
        made<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    inputs.vertexBindingDescriptionCount = attributes.empty() ? 0 : 1;
    inputs.pVertexBindingDescriptions = &buffer;
    inputs.vertexAttributeDescriptionCount = size_of(attributes);
    inputs.pVertexAttributeDescriptions = attributes.data();
    auto assembly = made<VkPipelineInputAssemblyStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    const VkViewport area{0, 0, 640, 480, 0, 1};
    const VkRect2D scissor{{0, 0}, {640, 480}};
    auto viewport =
        made<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewport.viewportCount = viewport.scissorCount = 1;
    viewport.pViewports = &area;
    viewport.pScissors = &scissor;
    auto rasterization = made<VkPipelineRasterizationStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    rasterization.lineWidth = 1;
    auto samples =
        made<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    auto depth = made<VkPipelineDepthStencilStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_LESS;
    std::vector<VkFormat> formats;
    for (const auto& output : pipeline.outputs) formats.push_back(target_of(output));
    VkPipelineColorBlendAttachmentState all_written{};
    all_written.colorWriteMask = 0xf;
    const std::vector masks(formats.size(), all_written);
    auto blending =
        made<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blending.attachmentCount = size_of(masks);
    blending.pAttachments = masks.data();
    auto targets = made<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
    targets.colorAttachmentCount = size_of(formats);
    targets.pColorAttachmentFormats = formats.data();
    targets.depthAttachmentFormat = VK_FORMAT_D32_SFLOAT;
    auto info = made<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &targets);
    info.flags = kCaptured;
    info.stageCount = size_of(stages);
    info.pStages = stages.data();
    info.pVertexInputState = &inputs;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blending;
    info.layout = layout;
    VkPipeline compiled = VK_NULL_HANDLE;
    GOBO_VULKAN(vkCreateGraphicsPipelines, device, VK_NULL_HANDLE, 1, &info, nullptr, &compiled);
    return compiled;
}

Result<VkPipeline> Driver::Device::compute_of(const VkPipelineShaderStageCreateInfo& stage,
                                              VkPipelineLayout layout) const {
    auto info = made<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.flags = kCaptured;
    info.stage = stage;
    info.layout = layout;
    VkPipeline compiled = VK_NULL_HANDLE;
    GOBO_VULKAN(vkCreateComputePipelines, device, VK_NULL_HANDLE, 1, &info, nullptr, &compiled);
    return compiled;
}

/// The last of the texts that the driver keeps: those before it are its own languages.
Result<std::string> Driver::Device::assembly_of(const VkPipelineExecutableInfoKHR& executable) const {
    std::uint32_t count = 0;
    GOBO_VULKAN(vkGetPipelineExecutableInternalRepresentationsKHR, device, &executable, &count, nullptr);
    std::vector texts(count, made<VkPipelineExecutableInternalRepresentationKHR>(
                                 VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR));
    GOBO_VULKAN(vkGetPipelineExecutableInternalRepresentationsKHR, device, &executable, &count, texts.data());
    if (texts.empty()) return "";
    // Where only the last one asks for its text, the driver writes only that.
    std::string text(texts.back().dataSize, '\0');
    texts.back().pData = text.data();
    vk.vkGetPipelineExecutableInternalRepresentationsKHR(device, &executable, &count, texts.data());
    return text.substr(0, text.find('\0'));
}

Result<std::vector<CompiledStage>> Driver::Device::stages_of(VkPipeline pipeline) const {
    auto info = made<VkPipelineInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR);
    info.pipeline = pipeline;
    std::uint32_t count = 0;
    GOBO_VULKAN(vkGetPipelineExecutablePropertiesKHR, device, &info, &count, nullptr);
    std::vector executables(
        count, made<VkPipelineExecutablePropertiesKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR));
    GOBO_VULKAN(vkGetPipelineExecutablePropertiesKHR, device, &info, &count, executables.data());
    std::vector<CompiledStage> stages;
    for (std::uint32_t i = 0; i < count; ++i) {
        auto executable = made<VkPipelineExecutableInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR);
        executable.pipeline = pipeline;
        executable.executableIndex = i;
        std::uint32_t statistic_count = 0;
        GOBO_VULKAN(vkGetPipelineExecutableStatisticsKHR, device, &executable, &statistic_count, nullptr);
        std::vector statistics(statistic_count, made<VkPipelineExecutableStatisticKHR>(
                                                    VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR));
        GOBO_VULKAN(vkGetPipelineExecutableStatisticsKHR, device, &executable, &statistic_count,
                    statistics.data());
        CompiledStage& stage = stages.emplace_back();
        for (const StageNames& names : kStages)
            if ((executables[i].stages & bit_of(names.kind)) != 0) stage.stage = names.name;
        stage.invocations = executables[i].subgroupSize;
        for (const auto& statistic : statistics) stage.statistics[statistic.name] = value_of(statistic);
        GOBO_TRY(stage.assembly, assembly_of(executable));
    }
    return stages;
}

Result<std::vector<CompiledStage>> Driver::compile(const Pipeline& pipeline) const {
    const Functions& vk = device_->vk;
    VkDevice device = device_->device;
    const VkShaderStageFlags seen_by =
        pipeline.is_compute() ? VK_SHADER_STAGE_COMPUTE_BIT : VK_SHADER_STAGE_ALL_GRAPHICS;
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const Descriptor& descriptor : pipeline.descriptors)
        bindings.push_back({size_of(bindings), type_of(descriptor.kind), descriptor.count, seen_by, nullptr});
    auto set_info =
        made<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set_info.bindingCount = size_of(bindings);
    set_info.pBindings = bindings.data();
    VkDescriptorSetLayout set = VK_NULL_HANDLE;
    GOBO_VULKAN(vkCreateDescriptorSetLayout, device, &set_info, nullptr, &set);
    auto layout_info = made<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &set;
    const VkPushConstantRange pushed{seen_by, 0, pipeline.push_bytes};
    layout_info.pushConstantRangeCount = pushed.size > 0 ? 1 : 0;
    layout_info.pPushConstantRanges = &pushed;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    GOBO_VULKAN(vkCreatePipelineLayout, device, &layout_info, nullptr, &layout);
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    for (const auto& [id, value] : pipeline.constants) {
        entries.push_back({id, static_cast<std::uint32_t>(sizeof(value) * values.size()), sizeof(value)});
        values.push_back(value);
    }
    const VkSpecializationInfo constants{size_of(entries), entries.data(),
                                         sizeof(std::uint32_t) * values.size(), values.data()};
    StageInfos infos;
    for (const PipelineStage& stage : pipeline.stages) {
        auto info =
            made<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
        info.stage = bit_of(stage.kind);
        GOBO_TRY(info.module, device_->module_of(stage.words));
        info.pName = "main";
        info.pSpecializationInfo = &constants;
        infos.push_back(info);
    }
    GOBO_TRY(const VkPipeline compiled, pipeline.is_compute()
                                            ? device_->compute_of(infos.front(), layout)
                                            : device_->graphics_of(pipeline, infos, layout));
    auto stages = device_->stages_of(compiled);
    vk.vkDestroyPipeline(device, compiled, nullptr);
    for (const auto& info : infos) vk.vkDestroyShaderModule(device, info.module, nullptr);
    vk.vkDestroyPipelineLayout(device, layout, nullptr);
    vk.vkDestroyDescriptorSetLayout(device, set, nullptr);
    return stages;
}

}  // namespace gobo::cost
