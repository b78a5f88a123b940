// Turns one planned pass into commands: barriers, descriptor sets, attachments, draws.
#pragma once
#include "engine/binding_check.hpp"
#include "engine/frame_slot.hpp"
#include "engine/pipelines.hpp"
#include "engine/schedule.hpp"

#include <span>
#include <vector>

namespace engine {

/// What stands behind an ImageId in this frame. Null for images that no pass of this frame touches.
struct BoundImage
{
    VkImage image = VK_NULL_HANDLE; // null for external images: they are only ever sampled
    VkImageView view = VK_NULL_HANDLE;
};

class Recorder
{
  public:
    Recorder(const Device& device, const Graph& graph, Pipelines& pipelines, FrameSlot& slot,
             VkCommandBuffer commands, std::span<const BoundImage> images);

    void barriers(std::span<const ImageBarrier> barriers) const;
    void record(const ComputePass& pass);
    void record(const RasterPass& pass, const PassPlan& planned);
    /// Copies images into `to`, one behind the other from `offsets` on, and makes them ready for the host.
    void copy_out(std::span<const Graph::Readback> readbacks, const Buffer& to,
                  std::span<const VkDeviceSize> offsets) const;

  private:
    void record_draw(const Draw& draw, const RasterPass& pass);
    void begin_rendering(const RasterPass& pass, const PassPlan& planned, VkExtent2D extent) const;
    VkDescriptorSet write_set(const Pipeline& pipeline, const BindingScope& scope);
    VkDescriptorBufferInfo upload(const ShaderGroup::Binding& binding, const Bindings::Data& data);

    const Device& device;
    const Graph& graph;
    Pipelines& pipelines;
    FrameSlot& slot;
    VkCommandBuffer commands;
    std::span<const BoundImage> images; // by ImageId
};

} // namespace engine
