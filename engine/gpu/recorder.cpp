#include "engine/gpu/recorder.hpp"

#include "engine/gpu/mesh_buffer.hpp"

#include <algorithm>
#include <deque>

namespace gpu {

Recorder::Recorder(const Device& device, const graph::Graph& graph, Pipelines& pipelines, FrameSlot& slot,
                   VkCommandBuffer commands, std::span<const BoundImage> images)
    : device_(device), graph_(graph), pipelines_(pipelines), slot_(slot), commands_(commands), images_(images)
{
}

void Recorder::barriers(std::span<const graph::ImageBarrier> list) const
{
    std::vector<VkImageMemoryBarrier2> image_barriers;
    for (const auto& [id, barrier] : list)
        image_barriers.push_back(
            graph::vulkan_barrier(barrier, images_[id.index].image,
                                  {.aspectMask = aspect_of(graph_.images[id.index].desc.format),
                                   .levelCount = 1,
                                   .layerCount = 1}));
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .imageMemoryBarrierCount =
                                          static_cast<std::uint32_t>(image_barriers.size()),
                                      .pImageMemoryBarriers = image_barriers.data()};
    if (!image_barriers.empty())
        vkCmdPipelineBarrier2(commands_, &dependency);
}

void Recorder::record(const graph::ComputePass& pass, const graph::PassPlan& planned)
{
    const Pipeline& pipeline = pipelines_.get(pass);
    const VkDescriptorSet set = write_set(pipeline, graph::BindingScope(pass));
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle);
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set, 0,
                            nullptr);
    const auto& local = pipeline.group->stages.front()->interface.local_size;
    const graph::Region region = planned.region.value_or(graph::Region{0, 0, pass.width, pass.height});
    const std::uint32_t first_x = region.x / local[0], first_y = region.y / local[1];
    vkCmdDispatchBase(commands_, first_x, first_y, 0,
                      (region.x + region.width + local[0] - 1) / local[0] - first_x,
                      (region.y + region.height + local[1] - 1) / local[1] - first_y, 1);
}

void Recorder::record(const graph::RasterPass& pass, const graph::PassPlan& planned)
{
    const graph::ImageId first = pass.colors.empty() ? pass.depth_image : pass.colors.front().image;
    const graph::ImageDesc& desc = graph_.images[first.index].desc;
    const VkViewport viewport{
        .width = static_cast<float>(desc.width), .height = static_cast<float>(desc.height), .maxDepth = 1.0f};
    const graph::Region region = planned.region.value_or(graph::Region{0, 0, desc.width, desc.height});
    // Attachments keep what lies outside the render area.
    const VkRect2D area{{std::int32_t(region.x), std::int32_t(region.y)}, {region.width, region.height}};
    begin_rendering(pass, planned, area);
    vkCmdSetViewport(commands_, 0, 1, &viewport);
    vkCmdSetScissor(commands_, 0, 1, &area);
    for (const graph::Draw& draw : pass.draws)
        record_draw(draw, pass);
    vkCmdEndRendering(commands_);
}

void Recorder::begin_rendering(const graph::RasterPass& pass, const graph::PassPlan& planned,
                               const VkRect2D& area) const
{
    std::vector<VkRenderingAttachmentInfo> colors;
    for (std::size_t i = 0; i < pass.colors.size(); ++i) {
        const graph::RasterPass::ColorTarget& target = pass.colors[i];
        VkRenderingAttachmentInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                       .imageView = images_[target.image.index].view,
                                       .imageLayout = graph::access_row(graph::Usage::Color).layout,
                                       .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                       .storeOp = planned.color_stores[i]};
        std::copy(target.clear.begin(), target.clear.end(), info.clearValue.color.float32);
        if (target.resolve.valid()) {
            info.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
            info.resolveImageView = images_[target.resolve.index].view;
            info.resolveImageLayout = graph::access_row(graph::Usage::Color).layout;
        }
        colors.push_back(info);
    }
    VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                    .imageLayout = graph::access_row(graph::Usage::Depth).layout,
                                    .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                    .storeOp = planned.depth_store,
                                    .clearValue = {.depthStencil = {.depth = pass.depth_clear}}};
    if (pass.depth_image.valid())
        depth.imageView = images_[pass.depth_image.index].view;
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = area,
                                    .layerCount = 1,
                                    .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                                    .pColorAttachments = colors.data(),
                                    .pDepthAttachment = pass.depth_image.valid() ? &depth : nullptr};
    vkCmdBeginRendering(commands_, &rendering);
}

void Recorder::record_draw(const graph::Draw& draw, const graph::RasterPass& pass)
{
    const Pipeline& pipeline = pipelines_.get(draw, pass, graph_);
    const VkDescriptorSet set = write_set(pipeline, graph::BindingScope(draw, pass));
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout, 0, 1, &set, 0,
                            nullptr);
    if (!draw.mesh) {
        vkCmdDraw(commands_, draw.index_count, 1, draw.first_index, 0);
        return;
    }
    const auto& mesh = static_cast<const MeshBuffer&>(*draw.mesh); // the only subclass
    const VkBuffer vertices = mesh.vertices();
    constexpr VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands_, 0, 1, &vertices, &offset);
    vkCmdBindIndexBuffer(commands_, mesh.indices(), 0, VK_INDEX_TYPE_UINT32);
    const std::uint32_t count = draw.index_count ? draw.index_count : mesh.index_count() - draw.first_index;
    vkCmdDrawIndexed(commands_, count, 1, draw.first_index, 0, 0);
}

VkDescriptorSet Recorder::write_set(const Pipeline& pipeline, const graph::BindingScope& scope)
{
    const VkDescriptorSet set = slot_.allocate_set(pipeline.set_layout);
    std::deque<VkDescriptorBufferInfo> buffers; // deques: pointers to elements stay valid
    std::deque<std::vector<VkDescriptorImageInfo>> image_lists;
    std::vector<VkWriteDescriptorSet> writes;
    for (const graph::ShaderGroup::Binding& binding : pipeline.group->bindings) {
        VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set,
                                   .dstBinding = binding.binding,
                                   .descriptorCount = binding.count,
                                   .descriptorType = binding.type};
        if (binding.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER) {
            const graph::Bindings::Sampled& sampled = *scope.sampled(binding.name);
            auto& list = image_lists.emplace_back();
            for (const graph::ImageId id : sampled.images)
                list.push_back({pipelines_.sampler(sampled.sampler), images_[id.index].view,
                                graph::access_row(graph::Usage::SampledInRaster).layout});
            write.pImageInfo = list.data();
        } else if (binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) {
            const graph::ImageId id = scope.stored(binding.name)->image;
            auto& list = image_lists.emplace_back();
            list.push_back(
                {VK_NULL_HANDLE, images_[id.index].view, graph::access_row(graph::Usage::Stored).layout});
            write.pImageInfo = list.data();
        } else
            write.pBufferInfo = &buffers.emplace_back(upload(binding, *scope.data(binding.name)));
        writes.push_back(write);
    }
    vkUpdateDescriptorSets(device_.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                           nullptr);
    return set;
}

VkDescriptorBufferInfo Recorder::upload(const graph::ShaderGroup::Binding& binding,
                                        const graph::Bindings::Data& data)
{
    const VkPhysicalDeviceLimits& limits = device_.limits();
    const VkDeviceSize alignment =
        data.storage ? limits.minStorageBufferOffsetAlignment : limits.minUniformBufferOffsetAlignment;
    // An empty array is bound as one element of zeros.
    const VkDeviceSize least = std::max(binding.size + binding.stride, 4u);
    const UploadedData uploaded =
        slot_.arena().add(data.bytes.view(), std::max<VkDeviceSize>(data.bytes.size(), least), alignment);
    return {uploaded.buffer, uploaded.offset, uploaded.size};
}

void Recorder::copy_out(std::span<const graph::Graph::Readback> readbacks, const Buffer& to,
                        std::span<const VkDeviceSize> offsets) const
{
    for (std::size_t i = 0; i < readbacks.size(); ++i) {
        const graph::ImageId id = readbacks[i].image;
        const graph::ImageDesc& desc = graph_.images[id.index].desc;
        const VkBufferImageCopy region{
            .bufferOffset = offsets[i],
            .imageSubresource = {.aspectMask = aspect_of(desc.format), .layerCount = 1},
            .imageExtent = {desc.width, desc.height, 1}};
        vkCmdCopyImageToBuffer(commands_, images_[id.index].image,
                               graph::access_row(graph::Usage::CopySource).layout, to.handle(), 1, &region);
    }
    const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = graph::access_row(graph::Usage::CopyDestination).stages,
                                   .srcAccessMask = graph::access_row(graph::Usage::CopyDestination).access,
                                   .dstStageMask = graph::access_row(graph::Usage::HostRead).stages,
                                   .dstAccessMask = graph::access_row(graph::Usage::HostRead).access};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands_, &dependency);
}

} // namespace gpu
