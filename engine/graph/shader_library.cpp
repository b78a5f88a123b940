#include "engine/graph/shader_library.hpp"

#include "engine/graph/find_named.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace graph {

namespace {

void merge_bindings(ShaderGroup& group, const Shader& shader)
{
    for (const ShaderBinding& binding : shader.interface.bindings) {
        const auto same =
            std::find_if(group.bindings.begin(), group.bindings.end(),
                         [&](const ShaderGroup::Binding& b) { return b.binding == binding.binding; });
        if (same == group.bindings.end()) {
            group.bindings.push_back({{binding}, static_cast<VkShaderStageFlags>(shader.interface.stage)});
            continue;
        }
        same->stages |= shader.interface.stage;
        if (same->name != binding.name || same->type != binding.type || same->count != binding.count ||
            same->size != binding.size)
            group.problems.push_back(fmt::format("binding {} is {} in one stage and {} in {}",
                                                 binding.binding, same->name, binding.name, shader.name));
    }
}

void merge_constants(ShaderGroup& group, const Shader& shader)
{
    for (const ShaderConstant& constant : shader.interface.constants) {
        const ShaderConstant* same = group.find_constant(constant.name);
        if (!same)
            group.constants.push_back(constant);
        else if (same->type != constant.type)
            group.problems.push_back(fmt::format("constant {} has two types", constant.name));
    }
}

} // namespace

const ShaderGroup::Binding* ShaderGroup::find_binding(std::string_view binding) const
{
    return find_named(bindings, binding);
}

const ShaderConstant* ShaderGroup::find_constant(std::string_view constant) const
{
    return find_named(constants, constant);
}

ShaderLibrary::ShaderLibrary(std::span<const EmbeddedShader> shaders)
{
    add(shaders);
}

void ShaderLibrary::add(std::span<const EmbeddedShader> shaders)
{
    for (const EmbeddedShader& shader : shaders)
        words_.emplace(shader.name, shader.words);
}

const Shader* ShaderLibrary::find(std::string_view name) const
{
    if (const auto known = reflected_.find(name); known != reflected_.end())
        return known->second.get();
    const auto found = words_.find(name);
    if (found == words_.end())
        return nullptr;
    auto shader = std::make_unique<Shader>(Shader{found->first, found->second, reflect(found->second)});
    return reflected_.emplace(name, std::move(shader)).first->second.get();
}

const ShaderGroup& ShaderLibrary::group(std::string_view name) const
{
    if (const auto known = groups_.find(name); known != groups_.end())
        return *known->second;
    auto group = std::make_unique<ShaderGroup>();
    group->name = name;
    std::vector<std::string> files{group->name};
    if (!name.ends_with(".comp"))
        files = {group->name + ".vert", group->name + ".frag"};
    for (const std::string& file : files) {
        const Shader* shader = find(file);
        if (!shader) {
            group->problems.push_back(fmt::format("there is no shader {}", file));
            continue;
        }
        group->stages.push_back(shader);
        for (const std::string& unsupported : shader->interface.unsupported)
            group->problems.push_back(fmt::format("{} uses {}", file, unsupported));
        merge_bindings(*group, *shader);
        merge_constants(*group, *shader);
    }
    return *groups_.emplace(name, std::move(group)).first->second;
}

} // namespace graph
