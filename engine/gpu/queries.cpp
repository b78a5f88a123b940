#include "engine/gpu/queries.hpp"

#include "engine/gpu/device.hpp"
#include "engine/gpu/vulkan_check.hpp"

#include <bit>
#include <cassert>

namespace gpu {

Queries::Queries(const Device& device, VkQueryType type, VkQueryPipelineStatisticFlags statistics)
    : device_(device), type_(type), statistics_(statistics)
{
}

Queries::~Queries()
{
    vkDestroyQueryPool(device_.handle(), pool_, nullptr);
}

void Queries::begin_frame(VkCommandBuffer commands, std::uint32_t most)
{
    room_ = most;
    used_ = 0;
    results_.clear();
    if (most > capacity_) {
        vkDestroyQueryPool(device_.handle(), pool_, nullptr);
        pool_ = VK_NULL_HANDLE;
        const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = type_,
                                         .queryCount = most,
                                         .pipelineStatistics = statistics_};
        check(vkCreateQueryPool(device_.handle(), &info, nullptr, &pool_), "create queries");
        capacity_ = most;
    }
    if (most > 0)
        vkCmdResetQueryPool(commands, pool_, 0, capacity_);
}

void Queries::timestamp(VkCommandBuffer commands)
{
    if (room_ == 0)
        return;
    assert(used_ < room_);
    // ALL_COMMANDS: after all earlier commands have completed, so the times of passes do not overlap.
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_, used_++);
}

void Queries::begin(VkCommandBuffer commands)
{
    assert(used_ < room_ || room_ == 0);
    if (room_ > 0)
        vkCmdBeginQuery(commands, pool_, used_, 0);
}

void Queries::end(VkCommandBuffer commands)
{
    if (room_ > 0)
        vkCmdEndQuery(commands, pool_, used_++);
}

void Queries::fetch()
{
    if (used_ == 0)
        return;
    const std::size_t each =
        type_ == VK_QUERY_TYPE_PIPELINE_STATISTICS ? static_cast<std::size_t>(std::popcount(statistics_)) : 1;
    results_.resize(used_ * each);
    check(vkGetQueryPoolResults(device_.handle(), pool_, 0, used_, results_.size() * sizeof(results_[0]),
                                results_.data(), each * sizeof(results_[0]),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "read queries");
}

} // namespace gpu
