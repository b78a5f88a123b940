#include "engine/graph/access.hpp"

#include <array>
#include <cassert>

namespace graph {

namespace {

constexpr std::array<AccessRow, 8> access_table{{
    {Usage::SampledInCompute, "sampled in compute", VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
     VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false,
     VK_IMAGE_USAGE_SAMPLED_BIT},
    {Usage::SampledInRaster, "sampled in raster",
     VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
     VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false,
     VK_IMAGE_USAGE_SAMPLED_BIT},
    {Usage::Stored, "stored", VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
     VK_IMAGE_LAYOUT_GENERAL, true, VK_IMAGE_USAGE_STORAGE_BIT},
    // Blending and load operations also read.
    {Usage::Color, "colour target", VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
    {Usage::Depth, "depth target",
     VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
     VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, true, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
    {Usage::CopySource, "copied from", VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
     VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false, VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
    {Usage::CopyDestination, "copied to", VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
     VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true,
     VK_IMAGE_USAGE_TRANSFER_DST_BIT},
    {Usage::HostRead, "read by the host", VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT,
     VK_IMAGE_LAYOUT_UNDEFINED, false, 0},
}};

constexpr VkAccessFlags2 all_writes =
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

/// Waits for the last access to the image. After a read no
/// flush is needed: the write was flushed before that read.
Barrier after_last_access(const AccessState& state, const AccessRow& next)
{
    return {.src_stages = state.read_stages ? state.read_stages : state.write_stages,
            .src_access = state.read_stages ? VkAccessFlags2{0} : state.write_access,
            .dst_stages = next.stages,
            .dst_access = next.access,
            .old_layout = state.layout,
            .new_layout = next.layout};
}

} // namespace

const AccessRow& access_row(Usage usage)
{
    const AccessRow& row = access_table[static_cast<std::size_t>(usage)];
    assert(row.usage == usage);
    return row;
}

VkImageMemoryBarrier2 vulkan_barrier(const Barrier& barrier, VkImage image,
                                     const VkImageSubresourceRange& range)
{
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = barrier.src_stages,
            .srcAccessMask = barrier.src_access,
            .dstStageMask = barrier.dst_stages,
            .dstAccessMask = barrier.dst_access,
            .oldLayout = barrier.old_layout,
            .newLayout = barrier.new_layout,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = range};
}

std::optional<Barrier> advance(AccessState& state, Usage usage, bool keep)
{
    const AccessRow& next = access_row(usage);
    if (next.writes) {
        Barrier barrier = after_last_access(state, next);
        if (!keep)
            barrier.old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
        state = {
            .layout = next.layout, .write_stages = next.stages, .write_access = next.access & all_writes};
        return barrier;
    }
    if (state.layout != next.layout) {
        // A layout transition is a write; its barrier flushes all earlier writes.
        const Barrier barrier = after_last_access(state, next);
        state = {.layout = next.layout,
                 .write_stages = next.stages,
                 .read_stages = next.stages,
                 .visible_stages = next.stages,
                 .visible_access = next.access};
        return barrier;
    }
    const bool visible =
        (next.stages & ~state.visible_stages) == 0 && (next.access & ~state.visible_access) == 0;
    state.read_stages |= next.stages;
    if (visible)
        return std::nullopt;
    state.visible_stages |= next.stages;
    state.visible_access |= next.access;
    return Barrier{.src_stages = state.write_stages,
                   .src_access = state.write_access,
                   .dst_stages = next.stages,
                   .dst_access = next.access,
                   .old_layout = state.layout,
                   .new_layout = next.layout};
}

} // namespace graph
