#include "engine/gpu/queries.hpp"

#include "engine/gpu/device.hpp"
#include "engine/gpu/vulkan_check.hpp"

#include <bit>
#include <cassert>

namespace gpu {

Queries::Queries(const Device& used_device, VkQueryType kind, VkQueryPipelineStatisticFlags flags)
    : device(used_device), type(kind), statistics(flags)
{
}

Queries::~Queries()
{
    vkDestroyQueryPool(device.handle(), pool, nullptr);
}

void Queries::begin_frame(VkCommandBuffer commands, std::uint32_t most)
{
    room = most;
    used = 0;
    results.clear();
    if (most > capacity) {
        vkDestroyQueryPool(device.handle(), pool, nullptr);
        pool = VK_NULL_HANDLE;
        const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = type,
                                         .queryCount = most,
                                         .pipelineStatistics = statistics};
        check(vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "create queries");
        capacity = most;
    }
    if (most > 0)
        vkCmdResetQueryPool(commands, pool, 0, capacity);
}

void Queries::timestamp(VkCommandBuffer commands)
{
    if (room == 0)
        return;
    assert(used < room);
    // ALL_COMMANDS: once everything recorded before is done, so neighbouring passes never share time.
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, used++);
}

void Queries::begin(VkCommandBuffer commands)
{
    assert(used < room || room == 0);
    if (room > 0)
        vkCmdBeginQuery(commands, pool, used, 0);
}

void Queries::end(VkCommandBuffer commands)
{
    if (room > 0)
        vkCmdEndQuery(commands, pool, used++);
}

void Queries::fetch()
{
    if (used == 0)
        return;
    const std::size_t each =
        type == VK_QUERY_TYPE_PIPELINE_STATISTICS ? static_cast<std::size_t>(std::popcount(statistics)) : 1;
    results.resize(used * each);
    check(vkGetQueryPoolResults(device.handle(), pool, 0, used, results.size() * sizeof(results[0]),
                                results.data(), each * sizeof(results[0]),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "read queries");
}

} // namespace gpu
