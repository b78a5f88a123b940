#include "engine/gpu/raster_pipeline.hpp"

#include "engine/gpu/vulkan_check.hpp"

#include <array>
#include <fmt/format.h>
#include <vector>

namespace gpu {

namespace {

VkPipelineColorBlendAttachmentState blend_state(bool blend)
{
    return {.blendEnable = blend,
            .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
            .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
            .colorBlendOp = VK_BLEND_OP_ADD,
            .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
            .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
            .alphaBlendOp = VK_BLEND_OP_ADD,
            .colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                              VK_COLOR_COMPONENT_A_BIT};
}

} // namespace

ShaderModule::ShaderModule(VkDevice device, std::span<const std::uint32_t> words, const std::string& name)
    : device_(device)
{
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = words.size_bytes(),
                                        .pCode = words.data()};
    check(vkCreateShaderModule(device_, &info, nullptr, &module_), fmt::format("load shader {}", name));
}

VkPipelineShaderStageCreateInfo ShaderModule::stage(VkShaderStageFlagBits which,
                                                    const VkSpecializationInfo* specialisation) const
{
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = which,
            .module = module_,
            .pName = "main",
            .pSpecializationInfo = specialisation};
}

VkPipeline make_raster_pipeline(VkDevice device, const RasterPipelineInfo& info, const std::string& name)
{
    const VkVertexInputBindingDescription vertices{
        .binding = 0, .stride = info.vertex_stride, .inputRate = VK_VERTEX_INPUT_RATE_VERTEX};
    const VkPipelineVertexInputStateCreateInfo vertex_input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = info.attributes.empty() ? 0u : 1u,
        .pVertexBindingDescriptions = &vertices,
        .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(info.attributes.size()),
        .pVertexAttributeDescriptions = info.attributes.data()};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo rasterisation{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode =
            static_cast<VkCullModeFlags>(info.cull_back_faces ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE),
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1.0f};
    const VkPipelineMultisampleStateCreateInfo multisample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = static_cast<VkSampleCountFlagBits>(info.samples)};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = info.depth_test,
        .depthWriteEnable = info.depth_write,
        .depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL};
    const std::vector<VkPipelineColorBlendAttachmentState> blends(info.colors.size(),
                                                                  blend_state(info.blend));
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = static_cast<std::uint32_t>(blends.size()),
        .pAttachments = blends.data()};
    constexpr std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic{.sType =
                                                       VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                   .dynamicStateCount = dynamic_states.size(),
                                                   .pDynamicStates = dynamic_states.data()};
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount =
                                                      static_cast<std::uint32_t>(info.colors.size()),
                                                  .pColorAttachmentFormats = info.colors.data(),
                                                  .depthAttachmentFormat = info.depth};
    const VkGraphicsPipelineCreateInfo create{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                              .pNext = &rendering,
                                              .stageCount = static_cast<std::uint32_t>(info.stages.size()),
                                              .pStages = info.stages.data(),
                                              .pVertexInputState = &vertex_input,
                                              .pInputAssemblyState = &assembly,
                                              .pViewportState = &viewport,
                                              .pRasterizationState = &rasterisation,
                                              .pMultisampleState = &multisample,
                                              .pDepthStencilState = &depth,
                                              .pColorBlendState = &blend,
                                              .pDynamicState = &dynamic,
                                              .layout = info.layout};
    VkPipeline made = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &create, nullptr, &made),
          fmt::format("compile {}", name));
    return made;
}

} // namespace gpu
