// Pipelines and samplers, made when first needed and kept.
#pragma once
#include "engine/binding_check.hpp"
#include "engine/graph.hpp"
#include "engine/shader_library.hpp"

#include <array>
#include <compare>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace engine {

class Device;

/// Everything a pipeline is compiled for.
struct PipelineKey
{
    std::string shader;                                           // name of the shader group
    std::vector<std::pair<std::string, std::uint32_t>> constants; // by name, as bit patterns
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
    const ShaderGroup* group = nullptr;
};

class Pipelines
{
  public:
    Pipelines(const Device& device, const ShaderLibrary& library);
    ~Pipelines();
    Pipelines(const Pipelines&) = delete;
    Pipelines& operator=(const Pipelines&) = delete;

    const Pipeline& get(const ComputePass& pass);
    const Pipeline& get(const Draw& draw, const RasterPass& pass, const Graph& graph);
    VkSampler sampler(Sampler kind) const { return samplers[static_cast<std::size_t>(kind)]; }

  private:
    struct Layout
    {
        VkDescriptorSetLayout set = VK_NULL_HANDLE;
        VkPipelineLayout pipeline = VK_NULL_HANDLE;
    };
    const Pipeline& find_or_make(const PipelineKey& key);
    const Layout& layout(const ShaderGroup& group);
    VkPipeline make_compute(const PipelineKey& key, const ShaderGroup& group, VkPipelineLayout layout) const;
    VkPipeline make_raster(const PipelineKey& key, const ShaderGroup& group, VkPipelineLayout layout) const;
    void make_samplers();

    const Device& device;
    const ShaderLibrary& library;
    std::array<VkSampler, 4> samplers{};
    std::map<std::string, Layout> layouts; // by shader group
    std::map<PipelineKey, Pipeline> pipelines;
};

} // namespace engine
