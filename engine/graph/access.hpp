// How the GPU touches an image, as one table: usage -> stages, access, layout. A barrier is an old row -> a
// new row. Nothing here calls Vulkan; tests/access_test.cpp reads the table as data.
#pragma once
#include <cstdint>
#include <optional>
#include <volk.h>

namespace graph {

enum class Usage : std::uint8_t
{
    SampledInCompute,
    SampledInRaster, // by the vertex or the fragment shader
    Stored,          // storage image of a compute shader, written whole
    Color,           // colour attachment or the target of a resolve
    Depth,
    CopySource,      // read back, or copied or blitted to a window
    CopyDestination, // uploads
    HostRead,        // buffers only: the end of a read-back
};

struct AccessRow
{
    Usage usage;
    const char* name;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    VkImageLayout layout;
    bool writes;             // and then replaces all of the image's contents
    VkImageUsageFlags image; // what the image must have been created for
};

const AccessRow& access_row(Usage usage);

/// What has happened to an image so far, in this frame or earlier ones on the same queue.
struct AccessState
{
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 write_stages = 0;   // of the last write or layout transition
    VkAccessFlags2 write_access = 0;          // of the last write, as long as it has not been flushed
    VkPipelineStageFlags2 read_stages = 0;    // all that read since then
    VkPipelineStageFlags2 visible_stages = 0; // to which the last write has been made visible
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

/// As Vulkan takes it.
VkImageMemoryBarrier2 vulkan_barrier(const Barrier& barrier, VkImage image,
                                     const VkImageSubresourceRange& range);

/// Moves `state` on by one access and returns the barrier that must come before it, if any.
std::optional<Barrier> advance(AccessState& state, Usage usage);

} // namespace graph
