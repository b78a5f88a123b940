// Lists the Vulkan devices with their features, checks the requirements on a device, and chooses one.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <volk.h>

namespace gpu {

/// Properties of a device that `cicatrix info` prints.
struct DeviceInfo
{
    std::string name, type,
        driver;                    // type: "discrete GPU", "CPU", ...; driver: its own name and version
    std::uint32_t api_version = 0; // VK_API_VERSION
    double memory_gib = 0;         // sum of the device-local heaps
    bool timestamps = false;
    bool statistics = false;                  // shader invocations can be counted
    bool calibrated = false;                  // its timestamps can be converted to the host's clock
    std::vector<std::uint32_t> sample_counts; // supported for both colour and depth targets
    bool software = false;                    // a rasteriser that runs on the CPU
    std::vector<std::string> missing;         // requirements that the device does not meet; empty: suitable
};

/// Required number of textures that one shader stage can sample; our shaders use at most this many.
/// Vulkan guarantees 16.
constexpr std::uint32_t textures_per_stage = 29;

struct PhysicalDevice
{
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    DeviceInfo info;
    VkPhysicalDeviceProperties properties{};
    std::uint32_t queue_family = 0; // graphics and compute
    std::uint32_t timestamp_bits = 0;
};

/// Requirements of a window, in addition to those of rendering.
struct DeviceWishes
{
    std::vector<const char*> extensions;
    std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t queue_family)>
        presents; // empty: no window
};

std::vector<PhysicalDevice> enumerate_devices(VkInstance instance, const DeviceWishes& wishes = {});

/// The device that `wanted` names (an index in the list, or part of a name, any case). Empty: the first
/// suitable device, discrete before integrated before virtual before CPU. Throws base::InputError with the
/// reason why each device is unsuitable.
const PhysicalDevice& choose_device(const std::vector<PhysicalDevice>& devices, std::string_view wanted);

/// The list for `cicatrix info`.
std::string to_text(const std::vector<PhysicalDevice>& devices);

} // namespace gpu
