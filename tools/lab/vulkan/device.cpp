#include "lab/vulkan/device.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/text.hpp"
#include "lab/vulkan/state.hpp"

namespace gobo::vulkan {
namespace {

constexpr const char* kInstall =
    "install a driver and Vulkan's loader: apt-get install mesa-vulkan-drivers libvulkan1";

/// What finds the functions: the loader's, which knows layers and all drivers, or that of Mesa's software
/// renderer where there is no loader.
Result<PFN_vkGetInstanceProcAddr> load_library() {
    std::string problem;
    for (const auto& [library, function] : {std::pair("libvulkan.so.1", "vkGetInstanceProcAddr"),
                                            std::pair("libvulkan_lvp.so", "vk_icdGetInstanceProcAddr")}) {
        void* const loaded = dlopen(library, RTLD_NOW | RTLD_LOCAL);
        if (loaded == nullptr) {
            if (problem.empty()) problem = dlerror();
            continue;
        }
        if (const auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(loaded, function))) return get;
    }
    return fail(Fault::file, fmt::format("cannot load Vulkan: {}", problem), kInstall);
}

VKAPI_ATTR VkBool32 VKAPI_CALL note_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                            VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    const auto* const state = static_cast<const Device::State*>(user);
    const std::lock_guard lock(state->mutex);
    state->messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

bool has_extension(PFN_vkGetInstanceProcAddr get, const char* name) {
    const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceExtensionProperties>(
        get(nullptr, "vkEnumerateInstanceExtensionProperties"));
    std::uint32_t count = 0;
    if (enumerate == nullptr || enumerate(nullptr, &count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkExtensionProperties> extensions(count);
    enumerate(nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
        return std::string_view(extension.extensionName) == name;
    });
}

/// Vulkan's loader passes over layers that VK_INSTANCE_LAYERS names and that are not here: their checks would
/// seem to pass.
Result<void> refuse_absent_layers(PFN_vkGetInstanceProcAddr get) {
    const char* const named = std::getenv("VK_INSTANCE_LAYERS");
    const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceLayerProperties>(
        get(nullptr, "vkEnumerateInstanceLayerProperties"));
    if (named == nullptr) return {};
    std::uint32_t count = 0;
    if (enumerate != nullptr) enumerate(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    if (enumerate != nullptr) enumerate(&count, layers.data());
    for (const std::string& name : split(named, ':'))
        if (std::ranges::none_of(layers,
                                 [&](const VkLayerProperties& layer) { return layer.layerName == name; }))
            return fail(Fault::file,
                        fmt::format("VK_INSTANCE_LAYERS names '{}', and there is no such layer", name),
                        "the validation layer is VK_LAYER_KHRONOS_validation: apt-get install "
                        "vulkan-validationlayers");
    return {};
}

Result<void> make_instance(Device::State& state, PFN_vkGetInstanceProcAddr get) {
    Functions& vk = state.vk;
    vk.vkCreateInstance = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
    auto application = made<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "gobo";
    application.apiVersion = VK_API_VERSION_1_2;
    auto messages =
        made<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    messages.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messages.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messages.pfnUserCallback = note_message;
    messages.pUserData = &state;
    auto info = made<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const bool listens = has_extension(get, extension);
    info.enabledExtensionCount = listens ? 1 : 0;
    info.ppEnabledExtensionNames = &extension;
    if (const VkResult result = vk.vkCreateInstance(&info, nullptr, &state.instance); result != VK_SUCCESS) {
        return fail(Fault::file, fmt::format("Vulkan gives no instance ({})", static_cast<int>(result)),
                    kInstall);
    }
#define GOBO_LOAD(function) vk.function = reinterpret_cast<PFN_##function>(get(state.instance, #function));
    GOBO_VULKAN_INSTANCE_FUNCTIONS(GOBO_LOAD)
#undef GOBO_LOAD
    if (!listens) return {};
    const auto listen = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        get(state.instance, "vkCreateDebugUtilsMessengerEXT"));
    vk.vkDestroyDebugUtilsMessengerEXT = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        get(state.instance, "vkDestroyDebugUtilsMessengerEXT"));
    if (listen != nullptr) listen(state.instance, &messages, nullptr, &state.messenger);
    return {};
}

/// The device to draw by, and its queue family.
struct Chosen {
    VkPhysicalDevice gpu;
    std::uint32_t family;
};
Result<Chosen> choose_device(const Device::State& state) {
    const Functions& vk = state.vk;
    std::uint32_t count = 0;
    vk.vkEnumeratePhysicalDevices(state.instance, &count, nullptr);
    std::vector<VkPhysicalDevice> gpus(count);
    vk.vkEnumeratePhysicalDevices(state.instance, &count, gpus.data());
    std::vector<Chosen> usual;
    for (const VkPhysicalDevice gpu : gpus) {
        std::uint32_t families = 0;
        vk.vkGetPhysicalDeviceQueueFamilyProperties(gpu, &families, nullptr);
        std::vector<VkQueueFamilyProperties> properties(families);
        vk.vkGetPhysicalDeviceQueueFamilyProperties(gpu, &families, properties.data());
        for (std::uint32_t family = 0; family < families; ++family) {
            if ((properties[family].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0) continue;
            auto described =
                made<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
            vk.vkGetPhysicalDeviceProperties2(gpu, &described);
            if (described.properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) return Chosen{gpu, family};
            usual.push_back({gpu, family});
            break;
        }
    }
    if (usual.empty()) return fail(Fault::file, "Vulkan has no device that draws", kInstall);
    return usual.front();
}

Result<void> make_device(Device::State& state, const Chosen& chosen) {
    Functions& vk = state.vk;
    auto driver = made<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto described =
        made<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver);
    vk.vkGetPhysicalDeviceProperties2(chosen.gpu, &described);
    state.name = fmt::format("{} through Vulkan, {}", described.properties.deviceName, driver.driverInfo);
    state.limits = described.properties.limits;
    vk.vkGetPhysicalDeviceMemoryProperties(chosen.gpu, &state.memory);
    VkPhysicalDeviceFeatures features{};  // whatever a shader may ask for
    vk.vkGetPhysicalDeviceFeatures(chosen.gpu, &features);
    const float priority = 1;
    auto queue = made<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = chosen.family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    auto info = made<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &features;
    GOBO_VULKAN_CALL(vkCreateDevice, chosen.gpu, &info, nullptr, &state.device);
#define GOBO_LOAD(function) \
    vk.function = reinterpret_cast<PFN_##function>(vk.vkGetDeviceProcAddr(state.device, #function));
    GOBO_VULKAN_DEVICE_FUNCTIONS(GOBO_LOAD)
#undef GOBO_LOAD
    vk.vkGetDeviceQueue(state.device, chosen.family, 0, &state.queue);
    auto pool = made<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.queueFamilyIndex = chosen.family;
    GOBO_VULKAN_CALL(vkCreateCommandPool, state.device, &pool, nullptr, &state.commands);
    return {};
}

}  // namespace

tl::unexpected<Diagnostics> fail_call(const char* function, VkResult result) {
    struct Row {
        VkResult result;
        const char* name;
        const char* help;
    };
    constexpr const char* kLost = "see whether a loop of the shaders ends, and what the system's log says";
    constexpr const char* kMemory = "draw fewer pictures at a time (-j 1), or smaller ones";
    constexpr const char* kOther = "try another driver: VK_ICD_FILENAMES chooses it";
    constexpr std::array<Row, 8> kRows = {{
        {VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST", kLost},
        {VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY", kMemory},
        {VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY", kMemory},
        {VK_ERROR_OUT_OF_POOL_MEMORY, "VK_ERROR_OUT_OF_POOL_MEMORY", kMemory},
        {VK_ERROR_MEMORY_MAP_FAILED, "VK_ERROR_MEMORY_MAP_FAILED", kMemory},
        {VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED", kOther},
        {VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT", kOther},
        {VK_ERROR_UNKNOWN, "VK_ERROR_UNKNOWN", kOther},
    }};
    const auto row = std::ranges::find(kRows, result, &Row::result);
    const bool is_known = row != kRows.end();
    return fail(Fault::file,
                fmt::format("the Vulkan driver answers {} with {}", function,
                            is_known ? row->name : fmt::format("VkResult {}", static_cast<int>(result))),
                is_known ? row->help : kOther);
}

Device::State::~State() {
    if (commands != VK_NULL_HANDLE) vk.vkDestroyCommandPool(device, commands, nullptr);
    if (device != VK_NULL_HANDLE) vk.vkDestroyDevice(device, nullptr);
    if (messenger != VK_NULL_HANDLE) vk.vkDestroyDebugUtilsMessengerEXT(instance, messenger, nullptr);
    if (instance != VK_NULL_HANDLE) vk.vkDestroyInstance(instance, nullptr);
}

Result<std::uint32_t> Device::State::memory_kind(std::uint32_t kinds,
                                                 VkMemoryPropertyFlags properties) const {
    for (std::uint32_t kind = 0; kind < memory.memoryTypeCount; ++kind)
        if ((kinds >> kind & 1U) != 0 && (memory.memoryTypes[kind].propertyFlags & properties) == properties)
            return kind;
    return fail(Fault::file, fmt::format("{} has no memory of a kind that is needed", name));
}

const std::string& Device::name() const {
    return state_->name;
}

int Device::largest_texture() const {
    return static_cast<int>(state_->limits.maxImageDimension2D);
}

Diagnostics Device::messages() const {
    std::vector<std::string> texts;
    {
        const std::lock_guard lock(state_->mutex);
        texts.swap(state_->messages);
    }
    Diagnostics errors;
    for (std::string& text : texts) {
        std::replace(text.begin(), text.end(), '\n', ' ');
        errors.push_back(fail(Fault::internal, "Vulkan's validation layer: " + text).value().front());
    }
    return errors;
}

Result<Device> open_device() {
    GOBO_TRY(const PFN_vkGetInstanceProcAddr get, load_library());
    GOBO_TRY_DO(refuse_absent_layers(get));
    auto state = std::make_shared<Device::State>();
    GOBO_TRY_DO(make_instance(*state, get));
    GOBO_TRY(const Chosen chosen, choose_device(*state));
    GOBO_TRY_DO(make_device(*state, chosen));
    return Device(std::move(state));
}

}  // namespace gobo::vulkan
