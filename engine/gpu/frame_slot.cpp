#include "engine/gpu/frame_slot.hpp"

#include "engine/gpu/vulkan_check.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

namespace gpu {

UploadedData UploadArena::add(std::span<const std::byte> bytes, VkDeviceSize size, VkDeviceSize alignment)
{
    constexpr VkDeviceSize block_size = 256 * 1024;
    assert(size >= bytes.size());
    used = (used + alignment - 1) / alignment * alignment;
    while (block < blocks.size() && used + size > blocks[block].size()) {
        ++block;
        used = 0;
    }
    if (block == blocks.size())
        blocks.emplace_back(device, std::max(size, block_size),
                            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                            HostAccess::Write, "frame data");
    std::byte* to = blocks[block].mapped().data() + used;
    if (!bytes.empty())
        std::memcpy(to, bytes.data(), bytes.size());
    std::memset(to + bytes.size(), 0, size - bytes.size());
    const UploadedData added{blocks[block].handle(), used, size};
    used += size;
    return added;
}

void UploadArena::reset()
{
    block = 0;
    used = 0;
}

DescriptorArena::~DescriptorArena()
{
    for (const VkDescriptorPool made : pools)
        vkDestroyDescriptorPool(device.handle(), made, nullptr);
}

VkDescriptorSet DescriptorArena::allocate(VkDescriptorSetLayout layout)
{
    for (;; ++pool) {
        const bool fresh = pool == pools.size();
        if (fresh) {
            constexpr std::array<VkDescriptorPoolSize, 4> sizes{{
                {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 512},
                {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 128},
                {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 128},
                {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 128},
            }};
            const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                                  .maxSets = 64,
                                                  .poolSizeCount = sizes.size(),
                                                  .pPoolSizes = sizes.data()};
            VkDescriptorPool made = VK_NULL_HANDLE;
            check(vkCreateDescriptorPool(device.handle(), &info, nullptr, &made), "create descriptors");
            pools.push_back(made);
        }
        const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                               .descriptorPool = pools[pool],
                                               .descriptorSetCount = 1,
                                               .pSetLayouts = &layout};
        VkDescriptorSet set = VK_NULL_HANDLE;
        const VkResult result = vkAllocateDescriptorSets(device.handle(), &info, &set);
        if (result == VK_SUCCESS)
            return set;
        const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
        if (!full || fresh)
            check(result, "allocate descriptors");
    }
}

void DescriptorArena::reset()
{
    for (const VkDescriptorPool made : pools)
        check(vkResetDescriptorPool(device.handle(), made, 0), "reset descriptors");
    pool = 0;
}

FrameSlot::FrameSlot(const Device& used)
    : device(used), uploads(used), sets(used), timestamps(used, VK_QUERY_TYPE_TIMESTAMP),
      counts(used, VK_QUERY_TYPE_PIPELINE_STATISTICS,
             VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
                 VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
                 VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT),
      commands(used.handle(), used.queue(), used.queue_family())
{
}

VkCommandBuffer FrameSlot::begin(std::uint32_t most_timestamps, std::uint32_t most_counts)
{
    wait();
    uploads.reset();
    sets.reset();
    const VkCommandBuffer begun = commands.begin();
    timestamps.begin_frame(begun, device.timestamp_bits() > 0 ? most_timestamps : 0);
    counts.begin_frame(begun, device.info().statistics ? most_counts : 0);
    return begun;
}

void FrameSlot::submit(bool calibrate)
{
    calibration = calibrate ? device.calibrate() : std::nullopt;
    commands.submit();
}

void FrameSlot::wait()
{
    if (!commands.wait())
        return;
    timestamps.fetch();
    counts.fetch();
}

double FrameSlot::milliseconds(std::size_t from, std::size_t to) const
{
    const std::span<const std::uint64_t> ticks = timestamps.values();
    assert(from < ticks.size() && to < ticks.size());
    return device.milliseconds(ticks[from], ticks[to]);
}

std::optional<Invocations> FrameSlot::invocations(std::size_t n) const
{
    const std::span<const std::uint64_t> values = counts.values(); // in the order of the flags' bits
    if (3 * n + 2 >= values.size())
        return std::nullopt;
    return Invocations{values[3 * n], values[3 * n + 1], values[3 * n + 2]};
}

std::optional<FrameSlot::Moment> FrameSlot::first_timestamp() const
{
    if (!calibration || !has_timestamps())
        return std::nullopt;
    const std::uint64_t first = timestamps.values().front();
    // Later, or by the clocks' deviation a little earlier; ticks wrap, so the shorter way round is meant.
    const double after_ms = device.milliseconds(calibration->ticks, first),
                 before_ms = device.milliseconds(first, calibration->ticks);
    const double offset_ms = after_ms <= before_ms ? after_ms : -before_ms;
    return Moment{calibration->host + std::chrono::nanoseconds(std::llround(offset_ms * 1e6)),
                  calibration->deviation_ms};
}

const Buffer& FrameSlot::readback(VkDeviceSize bytes)
{
    if (readback_buffer.size() < bytes)
        readback_buffer =
            Buffer(device, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostAccess::Read, "read-backs");
    return readback_buffer;
}

} // namespace gpu
