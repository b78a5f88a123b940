// Queries of one frame in flight: timestamps, or counts of shader invocations. The pool grows on demand.
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
    /// `statistics`: for VK_QUERY_TYPE_PIPELINE_STATISTICS; each flag adds one value per query.
    Queries(const Device& device, VkQueryType type, VkQueryPipelineStatisticFlags statistics = 0);
    ~Queries();
    Queries(const Queries&) = delete;
    Queries& operator=(const Queries&) = delete;

    /// Discards the last frame's results; `most` limits this frame's queries. 0: no queries are written.
    void begin_frame(VkCommandBuffer commands, std::uint32_t most);
    void timestamp(VkCommandBuffer commands); // does nothing when `most` was 0
    void begin(VkCommandBuffer commands);     // the same
    void end(VkCommandBuffer commands);
    /// Reads the results of a finished frame.
    void fetch();
    /// Values of all queries of the last fetched frame, in order of the queries.
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
