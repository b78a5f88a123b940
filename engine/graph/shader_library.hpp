// Compiled shaders by name, reflected on first use, and the groups of stages that form a pipeline.
#pragma once
#include "engine/graph/embedded_shaders.hpp"
#include "engine/graph/spirv.hpp"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace graph {

struct Shader
{
    std::string_view name;
    std::span<const std::uint32_t> words;
    ShaderInterface interface;
};

/// The stages of one pipeline and their merged interface.
struct ShaderGroup
{
    struct Binding : ShaderBinding
    {
        VkShaderStageFlags stages = 0;
    };
    std::string name;
    std::vector<const Shader*> stages; // one compute shader, or vertex and fragment
    std::vector<Binding> bindings;
    std::vector<ShaderConstant> constants; // by name; ids of one name may differ between stages
    std::vector<std::string> problems;     // why it cannot be used; empty: usable

    const Binding* find_binding(std::string_view binding) const;
    const ShaderConstant* find_constant(std::string_view constant) const;
};

class ShaderLibrary
{
  public:
    /// The arrays must outlive the library.
    explicit ShaderLibrary(std::span<const EmbeddedShader> shaders = embedded_shaders());
    void add(std::span<const EmbeddedShader> shaders);

    /// By file name, "forward.frag"; null when there is no such shader.
    const Shader* find(std::string_view name) const;

    /// "wound_texture.comp" is one compute shader; "forward" is forward.vert
    /// with forward.frag. Errors are listed in ShaderGroup::problems.
    const ShaderGroup& group(std::string_view name) const;

  private:
    std::map<std::string, std::span<const std::uint32_t>, std::less<>> words_;
    mutable std::map<std::string, std::unique_ptr<Shader>, std::less<>> reflected_;
    mutable std::map<std::string, std::unique_ptr<ShaderGroup>, std::less<>> groups_;
};

} // namespace graph
