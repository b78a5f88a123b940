// Which Vulkan devices there are, what each offers, what we ask of one, and which is taken.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <volk.h>

namespace gpu {

/// What `cicatrix info` prints about a device.
struct DeviceInfo
{
    std::string name, type,
        driver; // type: "discrete GPU", "CPU", ...; driver: name and version as the driver says
    std::uint32_t api_version = 0; // VK_API_VERSION
    double memory_gib = 0;         // of all heaps on the device
    bool timestamps = false;
    bool statistics = false;                  // shader invocations can be counted
    bool calibrated = false;                  // its timestamps can be told as moments of the host's clock
    std::vector<std::uint32_t> sample_counts; // of colour and depth targets
    bool software = false;                    // a rasteriser that runs on the CPU
    std::vector<std::string> missing;         // requirements it does not meet; empty: fit
};

/// Textures that one shader stage can sample on every device we take: the most that any of our shaders does.
/// Vulkan itself promises 16.
constexpr std::uint32_t textures_per_stage = 32;

struct PhysicalDevice
{
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    DeviceInfo info;
    VkPhysicalDeviceProperties properties{};
    std::uint32_t queue_family = 0; // graphics and compute
    std::uint32_t timestamp_bits = 0;
};

/// What a window asks of a device on top of what drawing does.
struct DeviceWishes
{
    std::vector<const char*> extensions;
    std::function<bool(VkInstance, VkPhysicalDevice, std::uint32_t queue_family)>
        presents; // empty: no window
};

std::vector<PhysicalDevice> enumerate_devices(VkInstance instance, const DeviceWishes& wishes = {});

/// The device that `wanted` names (an index in the list, or part of a name, any case), or, when it is empty,
/// the best fit one: discrete before integrated before virtual before CPU. Throws base::InputError saying
/// why each was refused.
const PhysicalDevice& choose_device(const std::vector<PhysicalDevice>& devices, std::string_view wanted);

/// The list as `cicatrix info` prints it.
std::string to_text(const std::vector<PhysicalDevice>& devices);

} // namespace gpu
