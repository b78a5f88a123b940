// Shader modules and graphics pipelines. All pipelines use triangle lists, at most one vertex buffer, dynamic
// viewport and scissor, dynamic rendering.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <volk.h>

namespace gpu {

/// Needed until the pipeline is created.
class ShaderModule
{
  public:
    ShaderModule(VkDevice device, std::span<const std::uint32_t> words, const std::string& name);
    ~ShaderModule() { vkDestroyShaderModule(device_, module_, nullptr); }
    ShaderModule(const ShaderModule&) = delete;
    ShaderModule& operator=(const ShaderModule&) = delete;

    /// `specialisation` must stay valid until the pipeline is created.
    VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which,
                                          const VkSpecializationInfo* specialisation = nullptr) const;

  private:
    VkDevice device_;
    VkShaderModule module_ = VK_NULL_HANDLE;
};

struct RasterPipelineInfo
{
    std::span<const VkPipelineShaderStageCreateInfo> stages;
    std::uint32_t vertex_stride = 0;                                    // bytes
    std::span<const VkVertexInputAttributeDescription> attributes = {}; // empty: no vertex buffer
    std::span<const VkFormat> colors;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    std::uint32_t samples = 1;
    bool cull_back_faces = false, blend = false; // blend: source alpha over, in all colour targets
    bool depth_test = false, depth_write = false;
    VkPipelineLayout layout = VK_NULL_HANDLE;
};

/// `name` is for the error message.
VkPipeline make_raster_pipeline(VkDevice device, const RasterPipelineInfo& info, const std::string& name);

} // namespace gpu
