// Draws Dear ImGui's draw lists. ImGui's Vulkan backend, as Debian builds it, links Vulkan's functions and
// supports only render passes. This program loads the functions at run time by volk, under the same names,
// and uses dynamic rendering.
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

    /// Uploads the fonts of the current ImGui context. Call again after each change of the fonts.
    void upload_fonts();
    /// Argument of ImGui::Image for a texture. The texture must live until the frame that shows it is drawn.
    static void* texture_id(const gpu::Texture& texture) { return texture.external().view; }

    /// Call inside dynamic rendering to a colour target of this format and size. The commands of the previous
    /// call must have completed.
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
