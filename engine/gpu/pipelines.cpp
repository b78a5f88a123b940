#include "engine/gpu/pipelines.hpp"

#include "engine/gpu/device.hpp"
#include "engine/gpu/mesh_buffer.hpp"
#include "engine/gpu/raster_pipeline.hpp"
#include "engine/gpu/vulkan_check.hpp"

#include <bit>
#include <fmt/format.h>

namespace gpu {

namespace {

std::uint32_t bit_pattern(const graph::Constant& value)
{
    return std::visit(
        [](auto v) -> std::uint32_t {
            if constexpr (std::is_same_v<decltype(v), bool>)
                return v ? VK_TRUE : VK_FALSE;
            else
                return std::bit_cast<std::uint32_t>(v);
        },
        value);
}

void add_constants(PipelineKey& key, const graph::ShaderGroup& group, const graph::BindingScope& scope)
{
    for (const graph::ShaderConstant& constant : group.constants)
        if (const graph::Constant* value = scope.constant(constant.name))
            key.constants.emplace_back(constant.name, bit_pattern(*value));
}

/// One shader stage with its specialisation constants, needed until the pipeline is created.
struct Stage
{
    Stage(VkDevice device, const graph::Shader& shader, const PipelineKey& key)
        : module(device, shader.words, std::string(shader.name))
    {
        for (const auto& [name, bits] : key.constants)
            if (const graph::ShaderConstant* constant = shader.interface.find_constant(name)) {
                entries.push_back(
                    {.constantID = constant->id,
                     .offset = static_cast<std::uint32_t>(values.size() * sizeof(std::uint32_t)),
                     .size = sizeof(std::uint32_t)});
                values.push_back(bits);
            }
        specialisation = {.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                          .pMapEntries = entries.data(),
                          .dataSize = values.size() * sizeof(std::uint32_t),
                          .pData = values.data()};
        info = module.stage(shader.interface.stage, &specialisation);
    }

    ShaderModule module;
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    VkSpecializationInfo specialisation{};
    VkPipelineShaderStageCreateInfo info{};
};

/// The attributes that the shader reads.
std::vector<VkVertexInputAttributeDescription> attributes(const graph::ShaderInterface& vertex_shader,
                                                          const graph::VertexLayout& vertices)
{
    std::vector<VkVertexInputAttributeDescription> list;
    for (const graph::ShaderInput& input : vertex_shader.inputs) {
        constexpr std::array formats{VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                     VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT};
        list.push_back({.location = input.location,
                        .binding = 0,
                        .format = formats[input.components - 1],
                        .offset = vertices.find(input.name)->offset});
    }
    return list;
}

} // namespace

Pipelines::Pipelines(const Device& device, const graph::ShaderLibrary& library)
    : device_(device), library_(library)
{
    make_samplers();
}

Pipelines::~Pipelines()
{
    for (const auto& [key, pipeline] : pipelines_)
        vkDestroyPipeline(device_.handle(), pipeline.handle, nullptr);
    for (const auto& [name, layout] : layouts_) {
        vkDestroyPipelineLayout(device_.handle(), layout.pipeline, nullptr);
        vkDestroyDescriptorSetLayout(device_.handle(), layout.set, nullptr);
    }
    for (const VkSampler sampler : samplers_)
        vkDestroySampler(device_.handle(), sampler, nullptr);
}

const Pipeline& Pipelines::get(const graph::ComputePass& pass)
{
    PipelineKey key{.shader = pass.shader, .constants = {}, .vertices = nullptr, .colors = {}};
    add_constants(key, library_.group(pass.shader), graph::BindingScope(pass));
    return find_or_make(key);
}

const Pipeline& Pipelines::get(const graph::Draw& draw, const graph::RasterPass& pass,
                               const graph::Graph& graph)
{
    PipelineKey key{.shader = draw.shader,
                    .constants = {},
                    .vertices = draw.mesh ? &draw.mesh->layout() : nullptr,
                    .colors = {},
                    .cull_back_faces = draw.mesh && draw.cull_back_faces,
                    .blend = draw.blend,
                    .depth_test = pass.depth_image.valid() && draw.depth_test,
                    .depth_write = pass.depth_image.valid() && draw.depth_write};
    add_constants(key, library_.group(draw.shader), graph::BindingScope(draw, pass));
    for (const graph::RasterPass::ColorTarget& target : pass.colors) {
        key.colors.push_back(graph.images[target.image.index].desc.format);
        key.samples = graph.images[target.image.index].desc.samples;
    }
    if (pass.depth_image.valid()) {
        key.depth = graph.images[pass.depth_image.index].desc.format;
        key.samples = graph.images[pass.depth_image.index].desc.samples;
    }
    return find_or_make(key);
}

const Pipeline& Pipelines::find_or_make(const PipelineKey& key)
{
    if (const auto known = pipelines_.find(key); known != pipelines_.end())
        return known->second;
    const graph::ShaderGroup& group = library_.group(key.shader);
    const Layout& used = layout(group);
    const bool compute = group.stages.front()->interface.stage == VK_SHADER_STAGE_COMPUTE_BIT;
    const VkPipeline made =
        compute ? make_compute(key, group, used.pipeline) : make_raster(key, group, used.pipeline);
    device_.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(made), key.shader);
    return pipelines_.emplace(key, Pipeline{made, used.pipeline, used.set, &group}).first->second;
}

const Pipelines::Layout& Pipelines::layout(const graph::ShaderGroup& group)
{
    const auto [place, fresh] = layouts_.try_emplace(group.name);
    Layout& made = place->second; // in the map, so that the destructor frees it after an exception
    if (made.pipeline)
        return made;
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const graph::ShaderGroup::Binding& binding : group.bindings)
        bindings.push_back({.binding = binding.binding,
                            .descriptorType = binding.type,
                            .descriptorCount = binding.count,
                            .stageFlags = binding.stages});
    const VkDescriptorSetLayoutCreateInfo set_info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = static_cast<std::uint32_t>(bindings.size()),
        .pBindings = bindings.data()};
    if (!made.set)
        check(vkCreateDescriptorSetLayout(device_.handle(), &set_info, nullptr, &made.set),
              "create a set layout");
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &made.set};
    check(vkCreatePipelineLayout(device_.handle(), &info, nullptr, &made.pipeline),
          "create a pipeline layout");
    return made;
}

VkPipeline Pipelines::make_compute(const PipelineKey& key, const graph::ShaderGroup& group,
                                   VkPipelineLayout layout) const
{
    const Stage stage(device_.handle(), *group.stages.front(), key);
    const VkComputePipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .flags = VK_PIPELINE_CREATE_DISPATCH_BASE_BIT, // a pass may write a region
        .stage = stage.info,
        .layout = layout};
    VkPipeline made = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &made),
          fmt::format("compile {}", key.shader));
    return made;
}

VkPipeline Pipelines::make_raster(const PipelineKey& key, const graph::ShaderGroup& group,
                                  VkPipelineLayout layout) const
{
    const Stage vertex(device_.handle(), *group.stages[0], key),
        fragment(device_.handle(), *group.stages[1], key);
    const std::array stages{vertex.info, fragment.info};
    const graph::VertexLayout vertices = key.vertices ? *key.vertices : graph::VertexLayout{};
    const auto inputs = attributes(group.stages[0]->interface, vertices);
    return make_raster_pipeline(device_.handle(),
                                {.stages = stages,
                                 .vertex_stride = vertices.stride,
                                 .attributes = inputs,
                                 .colors = key.colors,
                                 .depth = key.depth,
                                 .samples = key.samples,
                                 .cull_back_faces = key.cull_back_faces,
                                 .blend = key.blend,
                                 .depth_test = key.depth_test,
                                 .depth_write = key.depth_write,
                                 .layout = layout},
                                key.shader);
}

void Pipelines::make_samplers()
{
    struct Kind
    {
        graph::Sampler sampler;
        VkFilter filter;
        VkSamplerAddressMode address;
        float max_lod;
    };
    constexpr std::array<Kind, 4> kinds{{
        {graph::Sampler::LinearClamp, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, 0.0f},
        {graph::Sampler::LinearRepeatMips, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
         VK_LOD_CLAMP_NONE},
        {graph::Sampler::LinearClampMips, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
         VK_LOD_CLAMP_NONE},
        {graph::Sampler::NearestClamp, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, 0.0f},
    }};
    for (const Kind& kind : kinds) {
        const bool mips = kind.max_lod > 0.0f;
        const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                       .magFilter = kind.filter,
                                       .minFilter = kind.filter,
                                       .mipmapMode = mips ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                          : VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                       .addressModeU = kind.address,
                                       .addressModeV = kind.address,
                                       .addressModeW = kind.address,
                                       .maxLod = kind.max_lod};
        check(vkCreateSampler(device_.handle(), &info, nullptr,
                              &samplers_[static_cast<std::size_t>(kind.sampler)]),
              "create a sampler");
    }
}

} // namespace gpu
