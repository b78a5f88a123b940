// Queries of one frame in flight: timestamps, or counts of shader invocations. The pool grows as frames need.
#pragma once
#include <cstdint>
#include <span>
#include <vector>
#include <volk.h>

namespace gpu {

class Device;

class Queries
{
  public:
    /// `statistics` is for VK_QUERY_TYPE_PIPELINE_STATISTICS; each flag is one value of a result.
    Queries(const Device& device, VkQueryType type, VkQueryPipelineStatisticFlags statistics = 0);
    ~Queries();
    Queries(const Queries&) = delete;
    Queries& operator=(const Queries&) = delete;

    /// Forgets the last frame's and makes room for at most so many. 0: none will be asked for.
    void begin_frame(VkCommandBuffer commands, std::uint32_t most);
    void timestamp(VkCommandBuffer commands); // does nothing when no room was asked for
    void begin(VkCommandBuffer commands);     // the same
    void end(VkCommandBuffer commands);
    /// Of a finished frame.
    void fetch();
    /// All values of all queries of the frame fetched last, one query behind the other.
    std::span<const std::uint64_t> values() const { return results_; }

  private:
    const Device& device_;
    VkQueryType type_;
    VkQueryPipelineStatisticFlags statistics_;
    VkQueryPool pool_ = VK_NULL_HANDLE;
    std::uint32_t capacity_ = 0, room_ = 0, used_ = 0;
    std::vector<std::uint64_t> results_;
};

} // namespace gpu
