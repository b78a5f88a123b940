// Resources of one frame in flight: commands, descriptors, memory for uniforms and buffers, queries.
#pragma once
#include "engine/gpu/command_buffer.hpp"
#include "engine/gpu/device.hpp"
#include "engine/gpu/memory.hpp"
#include "engine/gpu/queries.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>
#include <volk.h>

namespace gpu {

/// Range of a buffer that the CPU has written for this frame.
struct UploadedData
{
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0, size = 0;
};

/// Uniform and storage data of one frame; grows by whole buffers, which later frames reuse.
class UploadArena
{
  public:
    explicit UploadArena(const Device& device) : device_(device) {}
    UploadedData add(std::span<const std::byte> bytes, VkDeviceSize size, VkDeviceSize alignment);
    void reset();

  private:
    const Device& device_;
    std::vector<Buffer> blocks_;
    std::size_t block_ = 0; // index of the one being filled
    VkDeviceSize used_ = 0; // bytes of that block
};

/// Descriptor sets of one frame; grows by whole pools, which later frames reuse.
class DescriptorArena
{
  public:
    explicit DescriptorArena(const Device& device) : device_(device) {}
    ~DescriptorArena();
    DescriptorArena(const DescriptorArena&) = delete;
    DescriptorArena& operator=(const DescriptorArena&) = delete;
    VkDescriptorSet allocate(VkDescriptorSetLayout layout);
    void reset();

  private:
    const Device& device_;
    std::vector<VkDescriptorPool> pools_;
    std::size_t pool_ = 0; // index of the one being filled
};

/// Number of shader invocations by stage. A device may count helper invocations or skip invocations.
struct Invocations
{
    std::uint64_t vertex = 0, fragment = 0, compute = 0;
};

class FrameSlot
{
  public:
    explicit FrameSlot(const Device& device);

    /// Waits for the slot's last frame and begins recording, with at most so many timestamps and counts.
    VkCommandBuffer begin(std::uint32_t timestamps, std::uint32_t counts);
    /// With `calibrate`, first calls Device::calibrate().
    void submit(bool calibrate);
    void wait();

    VkDescriptorSet allocate_set(VkDescriptorSetLayout layout) { return sets_.allocate(layout); }
    UploadArena& arena() { return uploads_; }
    void timestamp()
    {
        timestamps_.timestamp(commands_.handle());
    } // does nothing on a device without timestamps
    /// Counts the invocations of the commands in between. Call outside of rendering. Does nothing without
    /// requested counts or device support.
    void begin_count() { counts_.begin(commands_.handle()); }
    void end_count() { counts_.end(commands_.handle()); }
    /// Milliseconds between two timestamps of a finished frame. Only when has_timestamps().
    double milliseconds(std::size_t from, std::size_t to) const;
    bool has_timestamps() const { return !timestamps_.values().empty(); }
    /// The n-th count of the finished frame; none when it was not counted.
    std::optional<Invocations> invocations(std::size_t n) const;
    /// Host time of the first timestamp, from the calibration at submit().
    struct Moment
    {
        std::chrono::steady_clock::time_point time;
        double error_ms = 0; // in either direction
    };
    std::optional<Moment> first_timestamp() const;
    /// A buffer for readbacks of at least so many bytes.
    const Buffer& readback(VkDeviceSize bytes);

  private:
    const Device& device_;
    UploadArena uploads_;
    DescriptorArena sets_;
    Queries timestamps_, counts_;
    std::optional<Device::Calibration> calibration_; // of the last submitted frame
    Buffer readback_buffer_;
    CommandBuffer commands_; // last member: its destructor waits before the others are destroyed
};

} // namespace gpu
