// A Vulkan driver that compiles nothing: it does what the fragment stage is named after. Tests load it in
// place of Mesa's.
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#define VK_NO_PROTOTYPES
#include <unistd.h>
#include <vulkan/vulkan_core.h>

namespace {

/// Names in SPIR-V are bytes in order.
bool holds(const VkShaderModuleCreateInfo& module, const char* name) {
    const std::string bytes(reinterpret_cast<const char*>(module.pCode), module.codeSize);
    return bytes.find(name) != std::string::npos;
}

VkResult answer = VK_SUCCESS;

VkResult enumerate(VkInstance, std::uint32_t* count, VkPhysicalDevice* devices) {
    const char* family = std::getenv("RADV_FORCE_FAMILY");
    if (std::strcmp(family, "HAWAII") == 0) std::abort();
    if (std::strcmp(family, "TAHITI") == 0 || std::strcmp(family, "GFX1100") == 0) {
        static_cast<void>(::write(STDERR_FILENO, "fake: unknown chip\n", 19));
        std::abort();
    }
    *count = std::strcmp(family, "PITCAIRN") == 0 ? 0 : 1;
    if (devices != nullptr) *devices = nullptr;
    return VK_SUCCESS;
}

void properties(VkPhysicalDevice, VkPhysicalDeviceProperties2* told) {
    auto* driver = static_cast<VkPhysicalDeviceDriverProperties*>(told->pNext);
    std::strcpy(driver->driverName, "fake");
    std::strcpy(driver->driverInfo, "1.0");
}

void features(VkPhysicalDevice, VkPhysicalDeviceFeatures2* told) {
    for (auto* next = static_cast<VkBaseOutStructure*>(told->pNext); next != nullptr; next = next->pNext)
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR)
            reinterpret_cast<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR*>(next)
                ->pipelineExecutableInfo =
                std::strcmp(std::getenv("RADV_FORCE_FAMILY"), "BONAIRE") == 0 ? VK_FALSE : VK_TRUE;
}

VkResult create_module(VkDevice, const VkShaderModuleCreateInfo* info, const VkAllocationCallbacks*,
                       VkShaderModule*) {
    const char* family = std::getenv("RADV_FORCE_FAMILY");
    if (holds(*info, "fault_here")) {
        static_cast<void>(::write(STDERR_FILENO, "fake: of something else\n", 24));
        std::raise(SIGSEGV);
    }
    if (holds(*info, "abort_here") || std::strcmp(family, "FIJI") == 0) std::abort();
    while (holds(*info, "hang_here")) ::pause();
    if (holds(*info, "exit_here")) ::_exit(0);
    answer = holds(*info, "refuse_here") || std::strcmp(family, "TONGA") == 0 ? VK_ERROR_OUT_OF_DEVICE_MEMORY
                                                                              : VK_SUCCESS;
    return answer;
}

VkResult executables(VkDevice, const VkPipelineInfoKHR*, std::uint32_t* count,
                     VkPipelineExecutablePropertiesKHR* told) {
    *count = 1;
    if (told == nullptr) return VK_SUCCESS;
    told->stages = VK_SHADER_STAGE_FRAGMENT_BIT;
    told->subgroupSize = 32;
    return VK_SUCCESS;
}

VkResult statistics(VkDevice, const VkPipelineExecutableInfoKHR*, std::uint32_t* count,
                    VkPipelineExecutableStatisticKHR* told) {
    *count = 1;
    if (told == nullptr) return VK_SUCCESS;
    std::strcpy(told->name, "Inverse Throughput");
    told->format = VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR;
    told->value.u64 = 21;
    return VK_SUCCESS;
}

VkResult texts(VkDevice, const VkPipelineExecutableInfoKHR*, std::uint32_t* count,
               VkPipelineExecutableInternalRepresentationKHR*) {
    *count = 0;
    return VK_SUCCESS;
}

/// For every function that only has to be there.
VkResult succeed() {
    return VK_SUCCESS;
}

template <class Function>
PFN_vkVoidFunction as_any(Function* function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction function_named(void*, const char* name) {
    const std::string wanted = name;
    if (wanted == "vkGetDeviceProcAddr") return as_any(&function_named);
    if (wanted == "vkEnumeratePhysicalDevices") return as_any(&enumerate);
    if (wanted == "vkGetPhysicalDeviceProperties2") return as_any(&properties);
    if (wanted == "vkGetPhysicalDeviceFeatures2") return as_any(&features);
    if (wanted == "vkCreateShaderModule") return as_any(&create_module);
    if (wanted == "vkGetPipelineExecutablePropertiesKHR") return as_any(&executables);
    if (wanted == "vkGetPipelineExecutableStatisticsKHR") return as_any(&statistics);
    if (wanted == "vkGetPipelineExecutableInternalRepresentationsKHR") return as_any(&texts);
    return as_any(&succeed);
}

}  // namespace

extern "C" PFN_vkVoidFunction vk_icdGetInstanceProcAddr(VkInstance instance, const char* name) {
    return function_named(instance, name);
}
