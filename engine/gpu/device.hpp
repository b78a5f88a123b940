// The Vulkan instance, the device and its queue. Headless; a window adds the extensions it needs through
// DeviceOptions. The Vulkan library is loaded at run time; without it the constructor throws InputError.
#pragma once
#include "engine/gpu/device_choice.hpp"

#include <chrono>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include <volk.h>

namespace gpu {

struct DeviceOptions
{
    std::string device;      // part of a name or an index; empty: environment CICATRIX_DEVICE, else the best
    bool validation = false; // with synchronisation validation; CICATRIX_VALIDATION=1 does the same
    std::vector<const char*> instance_extensions; // in addition to those for headless work
    DeviceWishes wishes;                          // additional requirements on the device
};

/// Neither copied nor moved; everything created from it must be destroyed first.
class Device
{
  public:
    /// Throws base::InputError: no Vulkan library, no suitable device
    /// (with the reason for each), no validation layer.
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return physical_.info; }
    const VkPhysicalDeviceLimits& limits() const { return physical_.properties.limits; }
    VkInstance instance() const { return instance_; }
    VkPhysicalDevice physical_device() const { return physical_.handle; }
    VkDevice handle() const { return device_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queue_family() const { return physical_.queue_family; }
    std::uint32_t timestamp_bits() const { return info().timestamps ? physical_.timestamp_bits : 0; }

    /// Time between two timestamps of the device; correct when the counter wraps once.
    double milliseconds(std::uint64_t from_tick, std::uint64_t to_tick) const;
    /// The same moment on the device's and the host's clock.
    struct Calibration
    {
        std::uint64_t ticks = 0;
        std::chrono::steady_clock::time_point host;
        double deviation_ms = 0; // largest time between the two readings
    };
    std::optional<Calibration> calibrate() const; // none without calibrated timestamps

    /// A memory type among `allowed_types` with all properties of the first of `wishes` that any type has.
    std::uint32_t memory_type(std::uint32_t allowed_types,
                              std::initializer_list<VkMemoryPropertyFlags> wishes) const;
    VkMemoryPropertyFlags memory_flags(std::uint32_t type) const
    {
        return memory_.memoryTypes[type].propertyFlags;
    }

    /// Records commands, submits them and waits until they have run. For uploads.
    void run_once(const std::function<void(VkCommandBuffer)>& record) const;

    /// Names an object for validation messages and debuggers; needs VK_EXT_debug_utils, else does nothing.
    void name(VkObjectType type, std::uint64_t object, const std::string& name) const;

    /// Every warning and error of the validation layers since
    /// clear_validation_messages(). Empty without validation.
    std::vector<std::string> validation_messages() const;
    void clear_validation_messages();

  private:
    struct Messages;
    void create_instance(const DeviceOptions& options);
    void create_device(const DeviceOptions& options);
    void destroy();

    std::unique_ptr<Messages> messages_; // on the heap: the layers keep its address
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    PhysicalDevice physical_;
    VkPhysicalDeviceMemoryProperties memory_{};
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
};

/// The text of `cicatrix info`: every device with its features and missing requirements.
std::string describe_devices();

} // namespace gpu
