// What one frame in flight needs of its own: commands, descriptors, a place for uniforms, timestamps.
#pragma once
#include "engine/device.hpp"
#include "engine/memory.hpp"

#include <cstddef>
#include <span>
#include <vector>
#include <volk.h>

namespace engine {

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
    explicit UploadArena(const Device& on) : device(on) {}
    UploadedData add(std::span<const std::byte> bytes, VkDeviceSize size, VkDeviceSize alignment);
    void reset();

  private:
    const Device& device;
    std::vector<Buffer> blocks;
    std::size_t block = 0; // being filled
    VkDeviceSize used = 0; // bytes of it
};

class FrameSlot
{
  public:
    explicit FrameSlot(const Device& device);
    ~FrameSlot();
    FrameSlot(const FrameSlot&) = delete;
    FrameSlot& operator=(const FrameSlot&) = delete;

    /// Waits for the frame that used the slot last, begins recording; room for so many timestamps.
    VkCommandBuffer begin(std::uint32_t timestamps);
    void submit();
    void wait();

    VkDescriptorSet allocate_set(VkDescriptorSetLayout layout);
    UploadArena& arena() { return uploads; }
    void timestamp(); // does nothing on a device without timestamps
    /// Milliseconds between two timestamps of a finished frame. Only when has_timestamps().
    double milliseconds(std::size_t from, std::size_t to) const;
    bool has_timestamps() const { return !ticks.empty(); }
    /// At least so many bytes for read-backs.
    const Buffer& readback(VkDeviceSize bytes);

  private:
    void read_ticks();
    void destroy();

    const Device& device;
    UploadArena uploads;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    bool in_flight = false;
    std::vector<VkDescriptorPool> descriptor_pools;
    std::size_t descriptor_pool = 0; // being filled
    VkQueryPool queries = VK_NULL_HANDLE;
    std::uint32_t query_capacity = 0, query_count = 0;
    std::vector<std::uint64_t> ticks;
    Buffer readback_buffer;
};

} // namespace engine
