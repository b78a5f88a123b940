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
    used_ = (used_ + alignment - 1) / alignment * alignment;
    while (block_ < blocks_.size() && used_ + size > blocks_[block_].size()) {
        ++block_;
        used_ = 0;
    }
    if (block_ == blocks_.size())
        blocks_.emplace_back(device_, std::max(size, block_size),
                             VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                             HostAccess::Write, "frame data");
    std::byte* to = blocks_[block_].mapped().data() + used_;
    if (!bytes.empty())
        std::memcpy(to, bytes.data(), bytes.size());
    std::memset(to + bytes.size(), 0, size - bytes.size());
    const UploadedData added{blocks_[block_].handle(), used_, size};
    used_ += size;
    return added;
}

void UploadArena::reset()
{
    block_ = 0;
    used_ = 0;
}

DescriptorArena::~DescriptorArena()
{
    for (const VkDescriptorPool made : pools_)
        vkDestroyDescriptorPool(device_.handle(), made, nullptr);
}

VkDescriptorSet DescriptorArena::allocate(VkDescriptorSetLayout layout)
{
    for (;; ++pool_) {
        const bool fresh = pool_ == pools_.size();
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
            check(vkCreateDescriptorPool(device_.handle(), &info, nullptr, &made), "create descriptors");
            pools_.push_back(made);
        }
        const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                               .descriptorPool = pools_[pool_],
                                               .descriptorSetCount = 1,
                                               .pSetLayouts = &layout};
        VkDescriptorSet set = VK_NULL_HANDLE;
        const VkResult result = vkAllocateDescriptorSets(device_.handle(), &info, &set);
        if (result == VK_SUCCESS)
            return set;
        const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
        if (!full || fresh)
            check(result, "allocate descriptors");
    }
}

void DescriptorArena::reset()
{
    for (const VkDescriptorPool made : pools_)
        check(vkResetDescriptorPool(device_.handle(), made, 0), "reset descriptors");
    pool_ = 0;
}

FrameSlot::FrameSlot(const Device& device)
    : device_(device), uploads_(device), sets_(device), timestamps_(device, VK_QUERY_TYPE_TIMESTAMP),
      counts_(device, VK_QUERY_TYPE_PIPELINE_STATISTICS,
              VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
                  VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
                  VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT),
      commands_(device.handle(), device.queue(), device.queue_family())
{
}

VkCommandBuffer FrameSlot::begin(std::uint32_t most_timestamps, std::uint32_t most_counts)
{
    wait();
    uploads_.reset();
    sets_.reset();
    const VkCommandBuffer begun = commands_.begin();
    timestamps_.begin_frame(begun, device_.timestamp_bits() > 0 ? most_timestamps : 0);
    counts_.begin_frame(begun, device_.info().statistics ? most_counts : 0);
    return begun;
}

void FrameSlot::submit(bool calibrate)
{
    calibration_ = calibrate ? device_.calibrate() : std::nullopt;
    commands_.submit();
}

void FrameSlot::wait()
{
    if (!commands_.wait())
        return;
    timestamps_.fetch();
    counts_.fetch();
}

double FrameSlot::milliseconds(std::size_t from, std::size_t to) const
{
    const std::span<const std::uint64_t> ticks = timestamps_.values();
    assert(from < ticks.size() && to < ticks.size());
    return device_.milliseconds(ticks[from], ticks[to]);
}

std::optional<Invocations> FrameSlot::invocations(std::size_t n) const
{
    const std::span<const std::uint64_t> values = counts_.values(); // ordered by flag bit
    if (3 * n + 2 >= values.size())
        return std::nullopt;
    return Invocations{values[3 * n], values[3 * n + 1], values[3 * n + 2]};
}

std::optional<FrameSlot::Moment> FrameSlot::first_timestamp() const
{
    if (!calibration_ || !has_timestamps())
        return std::nullopt;
    const std::uint64_t first = timestamps_.values().front();
    // `first` is later, or earlier by at most the deviation; ticks wrap, so take the shorter difference.
    const double after_ms = device_.milliseconds(calibration_->ticks, first),
                 before_ms = device_.milliseconds(first, calibration_->ticks);
    const double offset_ms = after_ms <= before_ms ? after_ms : -before_ms;
    return Moment{calibration_->host + std::chrono::nanoseconds(std::llround(offset_ms * 1e6)),
                  calibration_->deviation_ms};
}

const Buffer& FrameSlot::readback(VkDeviceSize bytes)
{
    if (readback_buffer_.size() < bytes)
        readback_buffer_ =
            Buffer(device_, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostAccess::Read, "readbacks");
    return readback_buffer_;
}

} // namespace gpu
