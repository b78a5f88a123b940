// Draws Dear ImGui's draw lists. Its own Vulkan backend, as Debian builds it, calls Vulkan's functions by
// name and knows render passes only; ours are loaded at run time by volk, under the same names, and rendering
// is dynamic.
#pragma once
#include "engine/gpu/device.hpp"
#include "engine/gpu/memory.hpp"
#include "engine/gpu/texture.hpp"

#include <map>
#include <memory>

struct ImDrawData;

namespace window {

class UiRenderer
{
  public:
    explicit UiRenderer(const gpu::Device& device);
    ~UiRenderer();
    UiRenderer(const UiRenderer&) = delete;
    UiRenderer& operator=(const UiRenderer&) = delete;

    /// Uploads the fonts of the current ImGui context; again whenever they were changed.
    void upload_fonts();
    /// What ImGui::Image takes for a texture, which must live until the frame that shows it is drawn.
    static void* texture_id(const gpu::Texture& texture) { return texture.external().view; }

    /// Inside dynamic rendering to a colour target of this format and size. What the previous call recorded
    /// must have been executed.
    void record(VkCommandBuffer commands, const ImDrawData& data, VkFormat format, VkExtent2D size);

  private:
    VkPipeline pipeline_for(VkFormat format);
    void upload(const ImDrawData& data);
    VkDescriptorSet set_for(VkImageView view);
    void begin(VkCommandBuffer commands, const ImDrawData& data, VkFormat format, VkExtent2D size);
    void make_layouts();
    void destroy();

    const gpu::Device& device_;
    std::unique_ptr<gpu::Texture> fonts_;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    std::map<VkFormat, VkPipeline> pipelines_;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    std::map<VkImageView, VkDescriptorSet> sets_; // of this frame
    gpu::Buffer vertices_, indices_;
};

} // namespace window
