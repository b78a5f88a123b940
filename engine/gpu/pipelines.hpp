// Cache of pipelines, created on first use, and the samplers.
#pragma once
#include "engine/graph/binding_check.hpp"
#include "engine/graph/graph.hpp"
#include "engine/graph/shader_library.hpp"

#include <array>
#include <compare>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gpu {

class Device;

/// All state that a pipeline is compiled for.
struct PipelineKey
{
    std::string shader;                                           // name of the shader group
    std::vector<std::pair<std::string, std::uint32_t>> constants; // name and bit pattern
    const graph::VertexLayout* vertices = nullptr;                // null: the draw has no mesh
    std::vector<VkFormat> colors;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    std::uint32_t samples = 1;
    bool cull_back_faces = false, blend = false, depth_test = false, depth_write = false;
    auto operator<=>(const PipelineKey&) const = default;
};

struct Pipeline
{
    VkPipeline handle = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    const graph::ShaderGroup* group = nullptr;
};

class Pipelines
{
  public:
    Pipelines(const Device& device, const graph::ShaderLibrary& library);
    ~Pipelines();
    Pipelines(const Pipelines&) = delete;
    Pipelines& operator=(const Pipelines&) = delete;

    const Pipeline& get(const graph::ComputePass& pass);
    const Pipeline& get(const graph::Draw& draw, const graph::RasterPass& pass, const graph::Graph& graph);
    VkSampler sampler(graph::Sampler kind) const { return samplers_[static_cast<std::size_t>(kind)]; }

  private:
    struct Layout
    {
        VkDescriptorSetLayout set = VK_NULL_HANDLE;
        VkPipelineLayout pipeline = VK_NULL_HANDLE;
    };
    const Pipeline& find_or_make(const PipelineKey& key);
    const Layout& layout(const graph::ShaderGroup& group);
    VkPipeline make_compute(const PipelineKey& key, const graph::ShaderGroup& group,
                            VkPipelineLayout layout) const;
    VkPipeline make_raster(const PipelineKey& key, const graph::ShaderGroup& group,
                           VkPipelineLayout layout) const;
    void make_samplers();

    const Device& device_;
    const graph::ShaderLibrary& library_;
    std::array<VkSampler, 4> samplers_{};
    std::map<std::string, Layout> layouts_; // by shader group
    std::map<PipelineKey, Pipeline> pipelines_;
};

} // namespace gpu
