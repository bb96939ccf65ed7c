// lavapipe that aborts where it gets SPIR-V that names abort_here. RENDERER_LOST_AT is the submission of a
// process at which its device is lost, RENDERER_TALKS has it print to standard output, and RENDERER_EXITS end
// the process as it is opened. A test gives it to Vulkan's loader by VK_ICD_FILENAMES, and Mesa's own by
// RENDERER_DRAWS.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#define VK_NO_PROTOTYPES
#include <dlfcn.h>
#include <vulkan/vulkan_core.h>

namespace {

template <class Function>
Function mesas(const char* name) {
    static void* const library = ::dlopen(std::getenv("RENDERER_DRAWS"), RTLD_NOW | RTLD_LOCAL);
    return reinterpret_cast<Function>(::dlsym(library, name));
}

PFN_vkGetDeviceProcAddr device_functions = nullptr;

VkResult create_module(VkDevice device, const VkShaderModuleCreateInfo* info,
                       const VkAllocationCallbacks* allocator, VkShaderModule* module) {
    const std::string bytes(reinterpret_cast<const char*>(info->pCode), info->codeSize);
    if (bytes.find("abort_here") != std::string::npos) std::abort();
    return reinterpret_cast<PFN_vkCreateShaderModule>(device_functions(device, "vkCreateShaderModule"))(
        device, info, allocator, module);
}

PFN_vkQueueSubmit mesas_submit = nullptr;

VkResult submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* submissions, VkFence fence) {
    static int number = 0;
    if (std::getenv("RENDERER_TALKS") != nullptr) {
        std::puts("the driver talks");
        std::fflush(stdout);
    }
    const char* const lost_at = std::getenv("RENDERER_LOST_AT");
    if (lost_at != nullptr && ++number >= std::atoi(lost_at)) return VK_ERROR_DEVICE_LOST;
    return mesas_submit(queue, count, submissions, fence);
}

PFN_vkVoidFunction device_function(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkQueueSubmit") == 0) {
        mesas_submit = reinterpret_cast<PFN_vkQueueSubmit>(device_functions(device, name));
        return reinterpret_cast<PFN_vkVoidFunction>(&submit);
    }
    if (std::strcmp(name, "vkCreateShaderModule") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(&create_module);
    return device_functions(device, name);
}

}  // namespace

extern "C" {

PFN_vkVoidFunction vk_icdGetInstanceProcAddr(VkInstance instance, const char* name) {
    if (std::getenv("RENDERER_EXITS") != nullptr) std::exit(0);
    const auto function = mesas<PFN_vkGetInstanceProcAddr>("vk_icdGetInstanceProcAddr")(instance, name);
    if (std::strcmp(name, "vkGetDeviceProcAddr") != 0) return function;
    device_functions = reinterpret_cast<PFN_vkGetDeviceProcAddr>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
}
PFN_vkVoidFunction vk_icdGetPhysicalDeviceProcAddr(VkInstance instance, const char* name) {
    return mesas<PFN_vkGetInstanceProcAddr>("vk_icdGetPhysicalDeviceProcAddr")(instance, name);
}
VkResult vk_icdNegotiateLoaderICDInterfaceVersion(std::uint32_t* version) {
    return mesas<VkResult (*)(std::uint32_t*)>("vk_icdNegotiateLoaderICDInterfaceVersion")(version);
}
}
