#define VOLK_IMPLEMENTATION
#include "engine/gpu/device.hpp"

#include "base/input_error.hpp"
#include "engine/gpu/command_buffer.hpp"
#include "engine/gpu/vulkan_check.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <mutex>

#ifdef __SANITIZE_ADDRESS__
// Drivers and layers stay loaded until the process ends, or the leak
// checker would report the memory that they still use as leaked.
extern "C" int dlclose(void*)
{
    return 0;
}
#endif

namespace gpu {

namespace {

using base::InputError;

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

std::string environment(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// Loads the Vulkan library; a second call does nothing.
void load_vulkan()
{
    if (volkInitialize() != VK_SUCCESS)
        throw InputError("Vulkan", "the Vulkan library (libvulkan.so.1) was not found",
                         "install it with a driver (Debian: libvulkan1 and mesa-vulkan-drivers)");
    if (volkGetInstanceVersion() < VK_API_VERSION_1_3)
        throw InputError("Vulkan", "the Vulkan library is older than 1.3", "update libvulkan1");
}

bool has_layer(const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "list the layers");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "list the layers");
    return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, name) == 0;
    });
}

bool has_instance_extension(const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr), "list the extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()), "list the extensions");
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

/// Enables VK_EXT_debug_utils (names, labels, messages) wherever it is available: volk has one table of entry
/// points per process, so all instances must have the same extensions.
VkInstance make_instance(std::vector<const char*> extensions, const void* next, bool validation)
{
    if (has_instance_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME))
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "cicatrix",
                                        .pEngineName = "cicatrix",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = next,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = validation ? 1u : 0u,
                                    .ppEnabledLayerNames = &validation_layer,
                                    .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
    VkInstance instance = VK_NULL_HANDLE;
    check(vkCreateInstance(&info, nullptr, &instance), "create a Vulkan instance");
    // Entry points of the loader work with every instance and device, so several can exist at once.
    volkLoadInstance(instance);
    return instance;
}

} // namespace

struct Device::Messages
{
    mutable std::mutex mutex;
    std::vector<std::string> list;

    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user)
    {
        // Drivers use the same callback; the ids of Mesa's messages are its source files ("../src/...").
        const std::string_view id = data->pMessageIdName ? data->pMessageIdName : "";
        if (id.starts_with("../src/"))
            return VK_FALSE;
        auto& self = *static_cast<Messages*>(user);
        const std::lock_guard lock(self.mutex);
        self.list.push_back(fmt::format("{}: {}", id, data->pMessage ? data->pMessage : ""));
        return VK_FALSE;
    }

    VkDebugUtilsMessengerCreateInfoEXT create_info()
    {
        return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
                .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                   VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
                .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
                .pfnUserCallback = receive,
                .pUserData = this};
    }
};

Device::Device(const DeviceOptions& options) : messages_(std::make_unique<Messages>())
{
    try {
        create_instance(options);
        const std::string wanted = options.device.empty() ? environment("CICATRIX_DEVICE") : options.device;
        physical_ = choose_device(enumerate_devices(instance_, options.wishes), wanted);
        create_device(options);
    } catch (...) {
        destroy();
        throw;
    }
}

Device::~Device()
{
    destroy();
}

void Device::destroy()
{
    if (device_) {
        vkDeviceWaitIdle(device_);
        vkDestroyDevice(device_, nullptr);
    }
    if (messenger_)
        vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    if (instance_)
        vkDestroyInstance(instance_, nullptr);
}

void Device::create_instance(const DeviceOptions& options)
{
    load_vulkan();
    const bool validation = options.validation || environment("CICATRIX_VALIDATION") == "1";
    if (!validation) {
        instance_ = make_instance(options.instance_extensions, nullptr, false);
        return;
    }
    if (!has_layer(validation_layer) || !has_instance_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME))
        throw InputError("Vulkan validation", fmt::format("the layer {} is not installed", validation_layer),
                         "install it (Debian: vulkan-validationlayers) or do without validation");
    VkDebugUtilsMessengerCreateInfoEXT listener = messages_->create_info();
    const VkValidationFeatureEnableEXT synchronisation =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = &listener, // receives messages about vkCreateInstance
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &synchronisation};
    instance_ = make_instance(options.instance_extensions, &features, true);
    check(vkCreateDebugUtilsMessengerEXT(instance_, &listener, nullptr, &messenger_),
          "listen to the validation layer");
}

void Device::create_device(const DeviceOptions& options)
{
    vkGetPhysicalDeviceMemoryProperties(physical_.handle, &memory_);
    VkPhysicalDeviceVulkan13Features v13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                                         .synchronization2 = VK_TRUE,
                                         .dynamicRendering = VK_TRUE,
                                         .maintenance4 = VK_TRUE}; // for LocalSizeId of SPIR-V 1.6
    VkPhysicalDeviceVulkan12Features v12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                         .pNext = &v13,
                                         .scalarBlockLayout = VK_TRUE};
    VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &v12};
    features.features.shaderStorageImageExtendedFormats = VK_TRUE;
    features.features.pipelineStatisticsQuery = physical_.info.statistics ? VK_TRUE : VK_FALSE;
    std::vector<const char*> extensions = options.wishes.extensions;
    if (physical_.info.calibrated)
        extensions.push_back(VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);

    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue_info{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                             .queueFamilyIndex = physical_.queue_family,
                                             .queueCount = 1,
                                             .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue_info,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
    check(vkCreateDevice(physical_.handle, &info, nullptr, &device_), "create a Vulkan device");
    vkGetDeviceQueue(device_, physical_.queue_family, 0, &queue_);
}

double Device::milliseconds(std::uint64_t from_tick, std::uint64_t to_tick) const
{
    const std::uint32_t bits = timestamp_bits();
    const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    return static_cast<double>((to_tick - from_tick) & mask) * static_cast<double>(limits().timestampPeriod) *
           1e-6;
}

std::optional<Device::Calibration> Device::calibrate() const
{
    if (!info().calibrated)
        return std::nullopt;
    // std::chrono::steady_clock is CLOCK_MONOTONIC wherever Vulkan has this time domain.
    constexpr std::array<VkCalibratedTimestampInfoEXT, 2> clocks{
        {{.sType = VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT, .timeDomain = VK_TIME_DOMAIN_DEVICE_EXT},
         {.sType = VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT,
          .timeDomain = VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT}}};
    std::array<std::uint64_t, 2> values{};
    std::uint64_t deviation_ns = 0;
    check(vkGetCalibratedTimestampsEXT(device_, clocks.size(), clocks.data(), values.data(), &deviation_ns),
          "read the device's clock");
    return Calibration{values[0], std::chrono::steady_clock::time_point(std::chrono::nanoseconds(values[1])),
                       static_cast<double>(deviation_ns) * 1e-6};
}

std::uint32_t Device::memory_type(std::uint32_t allowed_types,
                                  std::initializer_list<VkMemoryPropertyFlags> wishes) const
{
    for (const VkMemoryPropertyFlags flags : wishes)
        for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
            if ((allowed_types >> i & 1u) && (memory_.memoryTypes[i].propertyFlags & flags) == flags)
                return i;
    throw InputError(fmt::format("device '{}'", info().name),
                     "it has no memory type with the required properties",
                     "choose another device with --device");
}

void Device::run_once(const std::function<void(VkCommandBuffer)>& record) const
{
    CommandBuffer commands(device_, queue_, physical_.queue_family);
    record(commands.begin());
    commands.submit();
    commands.wait();
}

void Device::name(VkObjectType type, std::uint64_t object, const std::string& name) const
{
    if (!vkSetDebugUtilsObjectNameEXT)
        return;
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = object,
                                             .pObjectName = name.c_str()};
    check(vkSetDebugUtilsObjectNameEXT(device_, &info), "name an object");
}

std::vector<std::string> Device::validation_messages() const
{
    const std::lock_guard lock(messages_->mutex);
    return messages_->list;
}

void Device::clear_validation_messages()
{
    const std::lock_guard lock(messages_->mutex);
    messages_->list.clear();
}

std::string describe_devices()
{
    load_vulkan();
    const VkInstance instance = make_instance({}, nullptr, false);
    const auto destroy = std::unique_ptr<VkInstance_T, void (*)(VkInstance)>(
        instance, [](VkInstance i) { vkDestroyInstance(i, nullptr); });
    const std::vector<PhysicalDevice> devices = enumerate_devices(instance);
    return devices.empty() ? "no Vulkan device found\n" : to_text(devices);
}

} // namespace gpu
