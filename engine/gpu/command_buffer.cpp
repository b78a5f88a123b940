#include "engine/gpu/command_buffer.hpp"

#include "engine/gpu/vulkan_check.hpp"

namespace gpu {

CommandBuffer::CommandBuffer(VkDevice device, VkQueue queue, std::uint32_t queue_family)
    : device_(device), queue_(queue)
{
    try {
        const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                                .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                                .queueFamilyIndex = queue_family};
        check(vkCreateCommandPool(device_, &pool_info, nullptr, &pool_), "create a command pool");
        const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                   .commandPool = pool_,
                                                   .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                   .commandBufferCount = 1};
        check(vkAllocateCommandBuffers(device_, &allocate, &commands_), "allocate a command buffer");
        const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        check(vkCreateFence(device_, &fence_info, nullptr, &fence_), "create a fence");
    } catch (...) {
        destroy();
        throw;
    }
}

CommandBuffer::~CommandBuffer()
{
    destroy();
}

void CommandBuffer::destroy()
{
    if (in_flight_) // errors are ignored: everything is destroyed even when the device is lost
        vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX);
    vkDestroyFence(device_, fence_, nullptr);
    vkDestroyCommandPool(device_, pool_, nullptr); // frees the command buffer, too
}

VkCommandBuffer CommandBuffer::begin()
{
    wait();
    check(vkResetCommandPool(device_, pool_, 0), "reset commands");
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(commands_, &info), "record commands");
    return commands_;
}

void CommandBuffer::submit(std::span<const VkSemaphoreSubmitInfo> waits,
                           std::span<const VkSemaphoreSubmitInfo> signals)
{
    check(vkEndCommandBuffer(commands_), "record commands");
    check(vkResetFences(device_, 1, &fence_), "reset a fence");
    const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                           .commandBuffer = commands_};
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .waitSemaphoreInfoCount = static_cast<std::uint32_t>(waits.size()),
                             .pWaitSemaphoreInfos = waits.data(),
                             .commandBufferInfoCount = 1,
                             .pCommandBufferInfos = &buffer,
                             .signalSemaphoreInfoCount = static_cast<std::uint32_t>(signals.size()),
                             .pSignalSemaphoreInfos = signals.data()};
    check(vkQueueSubmit2(queue_, 1, &info, fence_), "submit commands");
    in_flight_ = true;
}

bool CommandBuffer::wait()
{
    if (!in_flight_)
        return false;
    check(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "finish commands");
    in_flight_ = false;
    return true;
}

} // namespace gpu
