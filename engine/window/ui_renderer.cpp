#include "engine/window/ui_renderer.hpp"

#include "engine/gpu/raster_pipeline.hpp"
#include "engine/gpu/vulkan_check.hpp"
#include "engine/graph/embedded_shaders.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <imgui.h>

namespace window {

namespace {

constexpr std::uint32_t max_textures = 32; // per frame: the fonts and a few pictures

struct Scale // as in ui.vert
{
    float clip_per_pixel[2], clip_of_origin[2];
};

std::span<const std::uint32_t> words_of(std::string_view name)
{
    return std::ranges::find(graph::embedded_shaders(), name, &graph::EmbeddedShader::name)->words;
}

void grow(gpu::Buffer& buffer, const gpu::Device& device, std::size_t bytes, VkBufferUsageFlags usage)
{
    if (buffer.size() < bytes)
        buffer = gpu::Buffer(device, std::max<std::size_t>(2 * bytes, 1 << 16), usage, gpu::HostAccess::Write,
                             "ui");
}

} // namespace

UiRenderer::UiRenderer(const gpu::Device& device) : device_(device)
{
    try {
        make_layouts();
    } catch (...) {
        destroy();
        throw;
    }
}

UiRenderer::~UiRenderer()
{
    destroy();
}

void UiRenderer::destroy()
{
    for (const auto& [format, pipeline] : pipelines_)
        vkDestroyPipeline(device_.handle(), pipeline, nullptr);
    vkDestroyDescriptorPool(device_.handle(), descriptors_, nullptr);
    vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
    vkDestroySampler(device_.handle(), sampler_, nullptr);
}

void UiRenderer::make_layouts()
{
    const VkSamplerCreateInfo sampler_info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                           .magFilter = VK_FILTER_LINEAR,
                                           .minFilter = VK_FILTER_LINEAR,
                                           .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                           .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                           .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                           .maxLod = VK_LOD_CLAMP_NONE};
    gpu::check(vkCreateSampler(device_.handle(), &sampler_info, nullptr, &sampler_), "create a sampler");
    const VkDescriptorSetLayoutBinding binding{.binding = 0,
                                               .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                               .descriptorCount = 1,
                                               .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT};
    const VkDescriptorSetLayoutCreateInfo set_info{.sType =
                                                       VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                   .bindingCount = 1,
                                                   .pBindings = &binding};
    gpu::check(vkCreateDescriptorSetLayout(device_.handle(), &set_info, nullptr, &set_layout_),
               "create a set layout");
    const VkPushConstantRange range{.stageFlags = VK_SHADER_STAGE_VERTEX_BIT, .size = sizeof(Scale)};
    const VkPipelineLayoutCreateInfo layout_info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                 .setLayoutCount = 1,
                                                 .pSetLayouts = &set_layout_,
                                                 .pushConstantRangeCount = 1,
                                                 .pPushConstantRanges = &range};
    gpu::check(vkCreatePipelineLayout(device_.handle(), &layout_info, nullptr, &layout_),
               "create a pipeline layout");
    const VkDescriptorPoolSize size{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                    .descriptorCount = max_textures};
    const VkDescriptorPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                               .maxSets = max_textures,
                                               .poolSizeCount = 1,
                                               .pPoolSizes = &size};
    gpu::check(vkCreateDescriptorPool(device_.handle(), &pool_info, nullptr, &descriptors_),
               "create a descriptor pool");
}

VkPipeline UiRenderer::pipeline_for(VkFormat format)
{
    VkPipeline& made = pipelines_[format];
    if (made)
        return made;
    const gpu::ShaderModule vertex(device_.handle(), words_of("ui.vert"), "ui.vert"),
        fragment(device_.handle(), words_of("ui.frag"), "ui.frag");
    const std::array stages{vertex.stage(VK_SHADER_STAGE_VERTEX_BIT),
                            fragment.stage(VK_SHADER_STAGE_FRAGMENT_BIT)};
    constexpr std::array<VkVertexInputAttributeDescription, 3> attributes{
        {{.location = 0, .format = VK_FORMAT_R32G32_SFLOAT, .offset = offsetof(ImDrawVert, pos)},
         {.location = 1, .format = VK_FORMAT_R32G32_SFLOAT, .offset = offsetof(ImDrawVert, uv)},
         {.location = 2, .format = VK_FORMAT_R8G8B8A8_UNORM, .offset = offsetof(ImDrawVert, col)}}};
    made = gpu::make_raster_pipeline(device_.handle(),
                                     {.stages = stages,
                                      .vertex_stride = sizeof(ImDrawVert),
                                      .attributes = attributes,
                                      .colors = {&format, 1},
                                      .blend = true,
                                      .layout = layout_},
                                     "the user interface");
    return made;
}

void UiRenderer::upload_fonts()
{
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    vkQueueWaitIdle(device_.queue()); // the last frame may still use the old ones
    fonts_ = std::make_unique<gpu::Texture>(device_, cv::Mat(height, width, CV_8UC4, pixels),
                                            gpu::Encoding::Linear, false, "fonts");
    io.Fonts->SetTexID(texture_id(*fonts_));
    io.Fonts->ClearTexData(); // frees the CPU copy
}

void UiRenderer::upload(const ImDrawData& data)
{
    grow(vertices_, device_, std::size_t(data.TotalVtxCount) * sizeof(ImDrawVert),
         VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    grow(indices_, device_, std::size_t(data.TotalIdxCount) * sizeof(ImDrawIdx),
         VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    std::byte *to_vertices = vertices_.mapped().data(), *to_indices = indices_.mapped().data();
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        std::memcpy(to_vertices, list.VtxBuffer.Data, std::size_t(list.VtxBuffer.size_in_bytes()));
        std::memcpy(to_indices, list.IdxBuffer.Data, std::size_t(list.IdxBuffer.size_in_bytes()));
        to_vertices += list.VtxBuffer.size_in_bytes();
        to_indices += list.IdxBuffer.size_in_bytes();
    }
}

VkDescriptorSet UiRenderer::set_for(VkImageView view)
{
    VkDescriptorSet& set = sets_[view];
    if (set)
        return set;
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = descriptors_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &set_layout_};
    gpu::check(vkAllocateDescriptorSets(device_.handle(), &info, &set), "allocate a descriptor set");
    const VkDescriptorImageInfo image{sampler_, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = set,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                     .pImageInfo = &image};
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    return set;
}

void UiRenderer::begin(VkCommandBuffer commands, const ImDrawData& data, VkFormat format, VkExtent2D size)
{
    upload(data);
    sets_.clear();
    gpu::check(vkResetDescriptorPool(device_.handle(), descriptors_, 0), "reuse descriptors");
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_for(format));
    const VkDeviceSize offset = 0;
    const VkBuffer vertex_buffer = vertices_.handle();
    vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
    vkCmdBindIndexBuffer(commands, indices_.handle(), 0,
                         sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
    const VkViewport viewport{0, 0, float(size.width), float(size.height), 0, 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    Scale scale{{2 / data.DisplaySize.x, 2 / data.DisplaySize.y}, {}};
    scale.clip_of_origin[0] = -1 - data.DisplayPos.x * scale.clip_per_pixel[0];
    scale.clip_of_origin[1] = -1 - data.DisplayPos.y * scale.clip_per_pixel[1];
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(scale), &scale);
}

void UiRenderer::record(VkCommandBuffer commands, const ImDrawData& data, VkFormat format, VkExtent2D size)
{
    if (data.TotalIdxCount == 0 || data.DisplaySize.x <= 0 || data.DisplaySize.y <= 0)
        return;
    begin(commands, data, format, size);
    std::uint32_t first_index = 0;
    std::int32_t first_vertex = 0;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        for (const ImDrawCmd& draw : list.CmdBuffer) {
            const auto clip = [&](float value, float origin, float scale, std::uint32_t limit) {
                return std::int32_t(std::clamp((value - origin) * scale, 0.0f, float(limit)));
            };
            const ImVec2 origin = data.DisplayPos, scale = data.FramebufferScale;
            const std::int32_t left = clip(draw.ClipRect.x, origin.x, scale.x, size.width),
                               top = clip(draw.ClipRect.y, origin.y, scale.y, size.height),
                               right = clip(draw.ClipRect.z, origin.x, scale.x, size.width),
                               bottom = clip(draw.ClipRect.w, origin.y, scale.y, size.height);
            if (right <= left || bottom <= top || draw.ElemCount == 0)
                continue;
            const VkRect2D scissor{{left, top}, {std::uint32_t(right - left), std::uint32_t(bottom - top)}};
            vkCmdSetScissor(commands, 0, 1, &scissor);
            const VkDescriptorSet set = set_for(static_cast<VkImageView>(draw.GetTexID()));
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0,
                                    nullptr);
            vkCmdDrawIndexed(commands, draw.ElemCount, 1, first_index + draw.IdxOffset,
                             first_vertex + std::int32_t(draw.VtxOffset), 0);
        }
        first_index += std::uint32_t(list.IdxBuffer.Size);
        first_vertex += list.VtxBuffer.Size;
    }
}

} // namespace window
