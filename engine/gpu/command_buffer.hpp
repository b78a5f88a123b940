// Commands for the device's queue, and the fence that says when it is done with them.
#pragma once
#include <cstdint>
#include <span>
#include <volk.h>

namespace gpu {

/// One command buffer in a pool of its own, recorded and submitted any number of times, one at a time.
class CommandBuffer
{
  public:
    CommandBuffer(VkDevice device, VkQueue queue, std::uint32_t queue_family);
    ~CommandBuffer(); // waits until the device is done
    CommandBuffer(const CommandBuffer&) = delete;
    CommandBuffer& operator=(const CommandBuffer&) = delete;

    /// Waits as wait() does, forgets what was recorded and begins anew.
    VkCommandBuffer begin();
    /// Ends recording.
    void submit(std::span<const VkSemaphoreSubmitInfo> waits = {},
                std::span<const VkSemaphoreSubmitInfo> signals = {});
    /// Until the device is done with what was submitted; false: nothing was, or it has been waited for.
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
