#include "engine/gpu/device_choice.hpp"

#include "base/input_error.hpp"
#include "engine/gpu/vulkan_check.hpp"
#include "engine/graph/formats.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gpu {

namespace {

using base::InputError;

struct Features
{
    VkPhysicalDeviceVulkan13Features v13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                         .pNext = &v13};
    VkPhysicalDeviceFeatures2 v10{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &v12};
};

/// Required features. Some software drivers lack the others (64-bit floats, descriptor indexing, push
/// descriptors), so they are not used. Features for measuring are optional.
struct Requirement
{
    const char* name;
    bool (*met)(const Features&);
};
constexpr std::array<Requirement, 5> required_features{{
    {"synchronization2", [](const Features& f) { return f.v13.synchronization2 == VK_TRUE; }},
    {"dynamicRendering", [](const Features& f) { return f.v13.dynamicRendering == VK_TRUE; }},
    {"maintenance4", [](const Features& f) { return f.v13.maintenance4 == VK_TRUE; }},
    {"scalarBlockLayout", [](const Features& f) { return f.v12.scalarBlockLayout == VK_TRUE; }},
    {"shaderStorageImageExtendedFormats",
     [](const Features& f) { return f.v10.features.shaderStorageImageExtendedFormats == VK_TRUE; }},
}};

const char* type_name(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "CPU";
    default:
        return "other";
    }
}

/// Preference for a device type; 0 is best.
int rank(VkPhysicalDeviceType type)
{
    constexpr std::array order{VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
                               VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_CPU};
    return static_cast<int>(std::find(order.begin(), order.end(), type) - order.begin());
}

void find_queue_family(PhysicalDevice& device)
{
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const auto family = std::find_if(families.begin(), families.end(), [](const VkQueueFamilyProperties& f) {
        return (f.queueFlags & needed) == needed;
    });
    if (family == families.end()) {
        device.info.missing.push_back("a queue for graphics and compute");
        return;
    }
    device.queue_family = static_cast<std::uint32_t>(family - families.begin());
    device.timestamp_bits = family->timestampValidBits;
    device.info.timestamps = family->timestampValidBits > 0 && device.properties.limits.timestampPeriod > 0;
}

/// Whether the clocks of device and host (CLOCK_MONOTONIC) can be read at the same moment.
bool has_calibrated_timestamps(VkPhysicalDevice handle)
{
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(handle, nullptr, &count, nullptr), "list the extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(handle, nullptr, &count, extensions.data()),
          "list the extensions");
    if (std::ranges::none_of(extensions, [](const VkExtensionProperties& extension) {
            return std::string_view(extension.extensionName) == VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME;
        }))
        return false;
    check(vkGetPhysicalDeviceCalibrateableTimeDomainsEXT(handle, &count, nullptr), "list the clocks");
    std::vector<VkTimeDomainEXT> clocks(count);
    check(vkGetPhysicalDeviceCalibrateableTimeDomainsEXT(handle, &count, clocks.data()), "list the clocks");
    const auto has = [&](VkTimeDomainEXT clock) { return std::ranges::count(clocks, clock) > 0; };
    return has(VK_TIME_DOMAIN_DEVICE_EXT) && has(VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT);
}

void check_requirements(PhysicalDevice& device)
{
    Features features;
    vkGetPhysicalDeviceFeatures2(device.handle, &features.v10);
    device.info.statistics = features.v10.features.pipelineStatisticsQuery == VK_TRUE;
    device.info.calibrated = device.info.timestamps && has_calibrated_timestamps(device.handle);
    for (const Requirement& requirement : required_features)
        if (!requirement.met(features))
            device.info.missing.push_back(requirement.name);
    for (const graph::Format& format : graph::formats()) {
        VkFormatProperties properties{};
        vkGetPhysicalDeviceFormatProperties(device.handle, format.format, &properties);
        if ((properties.optimalTilingFeatures & format.needed) != format.needed)
            device.info.missing.push_back(fmt::format("full use of format {}", format.name));
    }
    if (std::find(device.info.sample_counts.begin(), device.info.sample_counts.end(), 4u) ==
        device.info.sample_counts.end())
        device.info.missing.push_back("4 samples per pixel");
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    if (std::min(limits.maxPerStageDescriptorSamplers, limits.maxPerStageDescriptorSampledImages) <
        textures_per_stage)
        device.info.missing.push_back(fmt::format("{} textures per shader stage", textures_per_stage));
}

void describe_memory_and_driver(PhysicalDevice& device)
{
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device.handle, &memory);
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            device.info.memory_gib += static_cast<double>(memory.memoryHeaps[i].size) / (1u << 30);
    VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &driver};
    vkGetPhysicalDeviceProperties2(device.handle, &properties);
    device.info.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
}

void check_wishes(PhysicalDevice& device, VkInstance instance, const DeviceWishes& wishes)
{
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(device.handle, nullptr, &count, nullptr),
          "list the extensions");
    std::vector<VkExtensionProperties> offered(count);
    check(vkEnumerateDeviceExtensionProperties(device.handle, nullptr, &count, offered.data()),
          "list the extensions");
    for (const char* wanted : wishes.extensions)
        if (std::ranges::none_of(offered, [&](const VkExtensionProperties& extension) {
                return std::strcmp(extension.extensionName, wanted) == 0;
            }))
            device.info.missing.push_back(wanted);
    if (wishes.presents && !wishes.presents(instance, device.handle, device.queue_family))
        device.info.missing.push_back("drawing to this display's windows");
}

PhysicalDevice inspect(VkInstance instance, VkPhysicalDevice handle, const DeviceWishes& wishes)
{
    PhysicalDevice device{.handle = handle};
    vkGetPhysicalDeviceProperties(handle, &device.properties);
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    device.info.name = device.properties.deviceName;
    device.info.type = type_name(device.properties.deviceType);
    device.info.api_version = device.properties.apiVersion;
    device.info.software = device.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    for (std::uint32_t count = 1; count <= 64; count *= 2)
        if (limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts & count)
            device.info.sample_counts.push_back(count);
    find_queue_family(device);
    if (device.properties.apiVersion < VK_API_VERSION_1_3) {
        device.info.missing.insert(device.info.missing.begin(), "Vulkan 1.3");
        return device; // the other queries need Vulkan 1.3
    }
    describe_memory_and_driver(device);
    check_requirements(device);
    check_wishes(device, instance, wishes);
    return device;
}

std::string version_text(std::uint32_t version)
{
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::string lower(std::string_view text)
{
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::string names(const std::vector<PhysicalDevice>& devices)
{
    std::vector<std::string> list;
    for (std::size_t i = 0; i < devices.size(); ++i)
        list.push_back(fmt::format("{} = {}", i, devices[i].info.name));
    return fmt::format("{}", fmt::join(list, ", "));
}

const PhysicalDevice* find_wanted(const std::vector<PhysicalDevice>& devices, std::string_view wanted)
{
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (error == std::errc{} && end == wanted.data() + wanted.size() && index < devices.size())
        return &devices[index];
    const auto named = std::find_if(devices.begin(), devices.end(), [&](const PhysicalDevice& device) {
        return lower(device.info.name).find(lower(wanted)) != std::string::npos;
    });
    return named == devices.end() ? nullptr : &*named;
}

} // namespace

std::vector<PhysicalDevice> enumerate_devices(VkInstance instance, const DeviceWishes& wishes)
{
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "list the devices");
    std::vector<VkPhysicalDevice> handles(count);
    check(vkEnumeratePhysicalDevices(instance, &count, handles.data()), "list the devices");
    std::vector<PhysicalDevice> devices;
    for (const VkPhysicalDevice handle : handles)
        devices.push_back(inspect(instance, handle, wishes));
    return devices;
}

const PhysicalDevice& choose_device(const std::vector<PhysicalDevice>& devices, std::string_view wanted)
{
    if (devices.empty())
        throw InputError("Vulkan", "no device found",
                         "install a driver (Debian: mesa-vulkan-drivers, which can also draw on the CPU)");
    if (!wanted.empty()) {
        const PhysicalDevice* device = find_wanted(devices, wanted);
        if (!device)
            throw InputError(fmt::format("device '{}'", wanted), "there is no such device",
                             fmt::format("choose by number or by part of a name: {}", names(devices)));
        if (!device->info.missing.empty())
            throw InputError(fmt::format("device '{}'", device->info.name),
                             fmt::format("it lacks {}", fmt::join(device->info.missing, ", ")),
                             fmt::format("choose another: {}", names(devices)));
        return *device;
    }
    const PhysicalDevice* best = nullptr;
    std::vector<std::string> refused;
    for (const PhysicalDevice& device : devices) {
        if (!device.info.missing.empty())
            refused.push_back(
                fmt::format("{} lacks {}", device.info.name, fmt::join(device.info.missing, ", ")));
        else if (!best || rank(device.properties.deviceType) < rank(best->properties.deviceType))
            best = &device;
    }
    if (!best)
        throw InputError("Vulkan", fmt::format("no device is suitable: {}", fmt::join(refused, "; ")),
                         "update the driver or install mesa-vulkan-drivers, which can draw on the CPU");
    return *best;
}

std::string to_text(const std::vector<PhysicalDevice>& devices)
{
    std::string text;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& info = devices[i].info;
        text += fmt::format("{}: {}\n", i, info.name);
        text +=
            fmt::format("   type        {}{}\n", info.type, info.software ? " (software rasteriser)" : "");
        text += fmt::format("   driver      {}\n", info.driver);
        text += fmt::format("   Vulkan      {}\n", version_text(info.api_version));
        text += fmt::format("   memory      {:.1f} GiB\n", info.memory_gib);
        text += fmt::format("   timestamps  {}\n", info.timestamps ? "yes" : "no: passes have no GPU times");
        text += fmt::format("   aligned     {}\n", info.calibrated
                                                       ? "yes, timestamps converted to the host's clock"
                                                       : "no, only bounded by submission and fence");
        text += fmt::format("   counts      {}\n", info.statistics ? "shader invocations" : "none");
        text += fmt::format("   samples     {}\n", fmt::join(info.sample_counts, ", "));
        text += info.missing.empty()
                    ? "   suitable    yes\n"
                    : fmt::format("   suitable    no, it lacks {}\n", fmt::join(info.missing, ", "));
    }
    return text;
}

} // namespace gpu
