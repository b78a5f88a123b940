// What one frame in flight needs of its own: commands, descriptors, a place for uniforms, timestamps.
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

/// A piece of a buffer that the CPU has written for this frame.
struct UploadedData
{
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0, size = 0;
};

/// Uniform and storage data of one frame; grows by whole buffers, which are kept for the frames to come.
class UploadArena
{
  public:
    explicit UploadArena(const Device& device) : device_(device) {}
    UploadedData add(std::span<const std::byte> bytes, VkDeviceSize size, VkDeviceSize alignment);
    void reset();

  private:
    const Device& device_;
    std::vector<Buffer> blocks_;
    std::size_t block_ = 0; // being filled
    VkDeviceSize used_ = 0; // bytes of it
};

/// Descriptor sets of one frame; grows by whole pools, which are kept for the frames to come.
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
    std::size_t pool_ = 0; // being filled
};

/// How often each kind of shader ran. A rasteriser may count helper invocations, or save some.
struct Invocations
{
    std::uint64_t vertex = 0, fragment = 0, compute = 0;
};

class FrameSlot
{
  public:
    explicit FrameSlot(const Device& device);

    /// Waits for the frame that used the slot last, begins recording; room for so many timestamps and counts.
    VkCommandBuffer begin(std::uint32_t timestamps, std::uint32_t counts);
    /// With `calibrate`, first notes which of the device's ticks is which moment of the host.
    void submit(bool calibrate);
    void wait();

    VkDescriptorSet allocate_set(VkDescriptorSetLayout layout) { return sets_.allocate(layout); }
    UploadArena& arena() { return uploads_; }
    void timestamp()
    {
        timestamps_.timestamp(commands_.handle());
    } // does nothing on a device without timestamps
    /// Counts what is recorded in between, outside of rendering; nothing when no room was asked for or the
    /// device cannot.
    void begin_count() { counts_.begin(commands_.handle()); }
    void end_count() { counts_.end(commands_.handle()); }
    /// Milliseconds between two timestamps of a finished frame. Only when has_timestamps().
    double milliseconds(std::size_t from, std::size_t to) const;
    bool has_timestamps() const { return !timestamps_.values().empty(); }
    /// Of the finished frame's n-th count; none when it was not counted.
    std::optional<Invocations> invocations(std::size_t n) const;
    /// When the first timestamp was taken, by the calibration at submit().
    struct Moment
    {
        std::chrono::steady_clock::time_point time;
        double error_ms = 0; // either way
    };
    std::optional<Moment> first_timestamp() const;
    /// At least so many bytes for read-backs.
    const Buffer& readback(VkDeviceSize bytes);

  private:
    const Device& device_;
    UploadArena uploads_;
    DescriptorArena sets_;
    Queries timestamps_, counts_;
    std::optional<Device::Calibration> calibration_; // of the frame submitted last
    Buffer readback_buffer_;
    CommandBuffer commands_; // last: it waits before what it uses goes
};

} // namespace gpu
