// Table of image usages: usage -> pipeline stages, access flags, layout. A barrier goes from one row to
// another. Nothing here calls Vulkan; tests/engine/access_test.cpp reads the table as data.
#pragma once
#include <cstdint>
#include <optional>
#include <volk.h>

namespace graph {

enum class Usage : std::uint8_t
{
    SampledInCompute,
    SampledInRaster, // by the vertex or fragment shader
    Stored,          // storage image of a compute shader, every texel written
    Color,           // colour attachment or resolve target
    Depth,
    CopySource,      // for a readback, or a copy or blit to a window
    CopyDestination, // uploads
    HostRead,        // buffers only: the host reads a readback
};

struct AccessRow
{
    Usage usage;
    const char* name;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    VkImageLayout layout;
    bool writes;             // true: the access replaces the whole contents
    VkImageUsageFlags image; // required at the image's creation
};

const AccessRow& access_row(Usage usage);

/// Previous accesses to an image, in this frame and earlier ones on the same queue.
struct AccessState
{
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 write_stages = 0;   // of the last write or layout transition
    VkAccessFlags2 write_access = 0;          // of the last write, 0 once it has been flushed
    VkPipelineStageFlags2 read_stages = 0;    // of all reads since the last write
    VkPipelineStageFlags2 visible_stages = 0; // that the last write is visible to
    VkAccessFlags2 visible_access = 0;
    bool operator==(const AccessState&) const = default;
};

struct Barrier
{
    VkPipelineStageFlags2 src_stages = 0;
    VkAccessFlags2 src_access = 0;
    VkPipelineStageFlags2 dst_stages = 0;
    VkAccessFlags2 dst_access = 0;
    VkImageLayout old_layout = VK_IMAGE_LAYOUT_UNDEFINED; // UNDEFINED: the old contents are not needed
    VkImageLayout new_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool operator==(const Barrier&) const = default;
};

/// The same barrier as a Vulkan struct.
VkImageMemoryBarrier2 vulkan_barrier(const Barrier& barrier, VkImage image,
                                     const VkImageSubresourceRange& range);

/// Updates `state` for one more access and returns the barrier needed before that access, if any. `keep`: a writer
/// replaces only a part of the contents.
std::optional<Barrier> advance(AccessState& state, Usage usage, bool keep = false);

} // namespace graph
