// Records the commands of planned passes: barriers, descriptor sets, attachments, draws.
#pragma once
#include "engine/gpu/frame_slot.hpp"
#include "engine/gpu/pipelines.hpp"
#include "engine/graph/binding_check.hpp"
#include "engine/graph/schedule.hpp"

#include <span>
#include <vector>

namespace gpu {

/// The Vulkan image of an ImageId in this frame. Null for images that no pass of this frame uses.
struct BoundImage
{
    VkImage image = VK_NULL_HANDLE; // null for external images, which are only sampled
    VkImageView view = VK_NULL_HANDLE;
};

class Recorder
{
  public:
    Recorder(const Device& device, const graph::Graph& graph, Pipelines& pipelines, FrameSlot& slot,
             VkCommandBuffer commands, std::span<const BoundImage> images);

    void barriers(std::span<const graph::ImageBarrier> barriers) const;
    void record(const graph::ComputePass& pass, const graph::PassPlan& planned);
    void record(const graph::RasterPass& pass, const graph::PassPlan& planned);
    /// Copies each image to its offset (bytes) in `to` and makes the data available to the host.
    void copy_out(std::span<const graph::Graph::Readback> readbacks, const Buffer& to,
                  std::span<const VkDeviceSize> offsets) const;

  private:
    void record_draw(const graph::Draw& draw, const graph::RasterPass& pass);
    void begin_rendering(const graph::RasterPass& pass, const graph::PassPlan& planned,
                         const VkRect2D& area) const;
    VkDescriptorSet write_set(const Pipeline& pipeline, const graph::BindingScope& scope);
    VkDescriptorBufferInfo upload(const graph::ShaderGroup::Binding& binding,
                                  const graph::Bindings::Data& data);

    const Device& device_;
    const graph::Graph& graph_;
    Pipelines& pipelines_;
    FrameSlot& slot_;
    VkCommandBuffer commands_;
    std::span<const BoundImage> images_; // by ImageId
};

} // namespace gpu
