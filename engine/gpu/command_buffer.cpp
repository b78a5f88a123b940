#include "engine/gpu/command_buffer.hpp"

#include "engine/gpu/vulkan_check.hpp"

namespace gpu {

CommandBuffer::CommandBuffer(VkDevice used, VkQueue to, std::uint32_t queue_family) : device(used), queue(to)
{
    try {
        const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                                .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                                .queueFamilyIndex = queue_family};
        check(vkCreateCommandPool(device, &pool_info, nullptr, &pool), "create a command pool");
        const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                   .commandPool = pool,
                                                   .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                   .commandBufferCount = 1};
        check(vkAllocateCommandBuffers(device, &allocate, &commands), "allocate a command buffer");
        const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        check(vkCreateFence(device, &fence_info, nullptr, &fence), "create a fence");
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
    if (in_flight) // nothing can be done about a lost device here; everything is destroyed all the same
        vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX);
    vkDestroyFence(device, fence, nullptr);
    vkDestroyCommandPool(device, pool, nullptr); // and the buffer with it
}

VkCommandBuffer CommandBuffer::begin()
{
    wait();
    check(vkResetCommandPool(device, pool, 0), "reset commands");
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(commands, &info), "record commands");
    return commands;
}

void CommandBuffer::submit(std::span<const VkSemaphoreSubmitInfo> waits,
                           std::span<const VkSemaphoreSubmitInfo> signals)
{
    check(vkEndCommandBuffer(commands), "record commands");
    check(vkResetFences(device, 1, &fence), "reset a fence");
    const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                           .commandBuffer = commands};
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .waitSemaphoreInfoCount = static_cast<std::uint32_t>(waits.size()),
                             .pWaitSemaphoreInfos = waits.data(),
                             .commandBufferInfoCount = 1,
                             .pCommandBufferInfos = &buffer,
                             .signalSemaphoreInfoCount = static_cast<std::uint32_t>(signals.size()),
                             .pSignalSemaphoreInfos = signals.data()};
    check(vkQueueSubmit2(queue, 1, &info, fence), "submit commands");
    in_flight = true;
}

bool CommandBuffer::wait()
{
    if (!in_flight)
        return false;
    check(vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX), "finish commands");
    in_flight = false;
    return true;
}

} // namespace gpu
