// A command buffer for the device's queue, and the fence that signals its completion.
#pragma once
#include <cstdint>
#include <span>
#include <volk.h>

namespace gpu {

/// One command buffer with its own pool. It can be reused, but only one submission is in flight.
class CommandBuffer
{
  public:
    CommandBuffer(VkDevice device, VkQueue queue, std::uint32_t queue_family);
    ~CommandBuffer(); // waits for the device
    CommandBuffer(const CommandBuffer&) = delete;
    CommandBuffer& operator=(const CommandBuffer&) = delete;

    /// Waits as wait() does, resets the command buffer and begins recording.
    VkCommandBuffer begin();
    /// Ends recording and submits.
    void submit(std::span<const VkSemaphoreSubmitInfo> waits = {},
                std::span<const VkSemaphoreSubmitInfo> signals = {});
    /// Waits for the submitted commands. False: nothing was in flight.
    bool wait();
    VkCommandBuffer handle() const { return commands_; }

  private:
    void destroy();

    VkDevice device_;
    VkQueue queue_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    bool in_flight_ = false;
};

} // namespace gpu
