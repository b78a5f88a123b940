#include "engine/graph/binding_check.hpp"

#include "engine/graph/find_named.hpp"
#include "engine/graph/formats.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace graph {

namespace {

// Vulkan's guaranteed minimum of maxUniformBufferRange.
constexpr std::uint32_t max_uniform_bytes = 16384;

std::set<std::string> given_names(const Bindings& bindings)
{
    std::set<std::string> names;
    for (const auto& sampled : bindings.sampled)
        names.insert(sampled.name);
    for (const auto& stored : bindings.stored)
        names.insert(stored.name);
    for (const auto& data : bindings.data)
        names.insert(data.name);
    for (const auto& [name, value] : bindings.constants)
        names.insert(name);
    return names;
}

bool has_name(const ShaderGroup& group, std::string_view name)
{
    return group.find_binding(name) || group.find_constant(name);
}

class BindingChecker
{
  public:
    BindingChecker(const Graph& graph, const ShaderLibrary& library) : graph_(graph), library_(library) {}

    std::vector<std::string> run()
    {
        for (const Pass& pass : graph_.passes) {
            pass_name_ = name_of(pass);
            std::visit([&](const auto& p) { check(p); }, pass);
        }
        return std::move(lines_);
    }

  private:
    template <typename... Args>
    void complain(fmt::format_string<Args...> format, Args&&... args)
    {
        lines_.push_back(fmt::format("pass {}: ", pass_name_) +
                         fmt::format(format, std::forward<Args>(args)...));
    }

    void check(const ComputePass& pass)
    {
        const ShaderGroup& group = library_.group(pass.shader);
        if (!pass.shader.ends_with(".comp"))
            complain("{} is not a compute shader", pass.shader);
        else if (usable(group))
            check_values(group, BindingScope(pass));
        if (group.problems.empty())
            for (const std::string& name : given_names(pass))
                if (!has_name(group, name))
                    complain("shader {} has no binding or constant {}", pass.shader, name);
    }

    void check(const RasterPass& pass)
    {
        std::set<std::string> unused = given_names(pass);
        for (const Draw& draw : pass.draws) {
            const ShaderGroup& group = library_.group(draw.shader);
            if (draw.shader.ends_with(".comp"))
                complain("{} is a compute shader", draw.shader);
            else if (usable(group)) {
                check_values(group, BindingScope(draw, pass));
                check_inputs(group, draw);
                if (const auto written = group.stages.back()->interface.outputs; written < pass.colors.size())
                    complain("shader {} writes {} colours, the pass has {} targets", draw.shader, written,
                             pass.colors.size());
            }
            for (const std::string& name : given_names(draw))
                if (group.problems.empty() && !has_name(group, name))
                    complain("shader {} has no binding or constant {}", draw.shader, name);
            std::erase_if(unused, [&](const std::string& name) { return has_name(group, name); });
        }
        for (const std::string& name : unused)
            complain("no shader of its draws has a binding or constant {}", name);
    }

    bool usable(const ShaderGroup& group)
    {
        for (const std::string& problem : group.problems)
            complain("{}", problem);
        return group.problems.empty();
    }

    void check_values(const ShaderGroup& group, const BindingScope& scope)
    {
        for (const ShaderGroup::Binding& binding : group.bindings)
            check_value(group, binding, scope);
        for (const ShaderConstant& constant : group.constants)
            if (const Constant* value = scope.constant(constant.name);
                value && value->index() != static_cast<std::size_t>(constant.type))
                complain("shader {} is given constant {} with another type", group.name, constant.name);
    }

    void check_value(const ShaderGroup& group, const ShaderGroup::Binding& binding, const BindingScope& scope)
    {
        const auto missing = [&](const char* what) {
            complain("shader {} is given no {} for {}", group.name, what, binding.name);
        };
        switch (binding.type) {
        case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
            if (const auto* sampled = scope.sampled(binding.name); !sampled)
                missing("image");
            else if (sampled->images.size() != binding.count)
                complain("shader {} wants {} images for {} and is given {}", group.name, binding.count,
                         binding.name, sampled->images.size());
            return;
        case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
            if (const auto* stored = scope.stored(binding.name); !stored)
                missing("image to store to");
            else if (stored->image.index < graph_.images.size() &&
                     graph_.images[stored->image.index].desc.format != binding.format)
                complain("shader {} stores {} to {}, which has another format", group.name,
                         find_format(binding.format)->name, graph_.images[stored->image.index].name);
            return;
        default:
            check_data(group, binding, scope.data(binding.name));
        }
    }

    void check_data(const ShaderGroup& group, const ShaderGroup::Binding& binding, const Bindings::Data* data)
    {
        const bool storage = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        if (!data || data->storage != storage) {
            complain("shader {} is given no {} for {}", group.name, storage ? "buffer" : "uniform",
                     binding.name);
            return;
        }
        if (!storage && binding.size > max_uniform_bytes)
            complain("uniform {} has {} bytes; more than {} must be a buffer", binding.name, binding.size,
                     max_uniform_bytes);
        if (!storage && data->bytes.size() != binding.size)
            complain("shader {} wants {} bytes for {} and is given {}", group.name, binding.size,
                     binding.name, data->bytes.size());
        if (storage && binding.size != 0 && binding.stride == 0 && data->bytes.size() != binding.size)
            complain("shader {} wants {} bytes for {} and is given {}", group.name, binding.size,
                     binding.name, data->bytes.size());
        if (storage && binding.stride != 0 &&
            (data->bytes.size() < binding.size || (data->bytes.size() - binding.size) % binding.stride != 0))
            complain("shader {} wants elements of {} bytes for {} and is given {} bytes", group.name,
                     binding.stride, binding.name, data->bytes.size());
    }

    void check_inputs(const ShaderGroup& group, const Draw& draw)
    {
        const std::vector<ShaderInput>& inputs = group.stages.front()->interface.inputs;
        for (const ShaderInput& input : inputs) {
            const VertexAttribute* given = draw.mesh ? draw.mesh->layout().find(input.name) : nullptr;
            if (draw.mesh && (!given || given->components < input.components))
                complain("shader {} wants vertex input {} with {} components, which its mesh lacks",
                         group.name, input.name, input.components);
        }
        if (!inputs.empty() && !draw.mesh)
            complain("draw {} has no mesh, and its shader reads {}", group.name, inputs.front().name);
        if (draw.mesh && (draw.first_index >= draw.mesh->index_count() ||
                          draw.index_count > draw.mesh->index_count() - draw.first_index))
            complain("draw {} reads {} indices from {} on, its mesh has {}", group.name, draw.index_count,
                     draw.first_index, draw.mesh->index_count());
    }

    const Graph& graph_;
    const ShaderLibrary& library_;
    std::string pass_name_;
    std::vector<std::string> lines_;
};

} // namespace

const Bindings::Sampled* BindingScope::sampled(std::string_view name) const
{
    const Bindings::Sampled* found = find_named(own_.sampled, name);
    return found || !outer_ ? found : find_named(outer_->sampled, name);
}

const Bindings::Stored* BindingScope::stored(std::string_view name) const
{
    return find_named(own_.stored, name);
}

const Bindings::Data* BindingScope::data(std::string_view name) const
{
    const Bindings::Data* found = find_named(own_.data, name);
    return found || !outer_ ? found : find_named(outer_->data, name);
}

const Constant* BindingScope::constant(std::string_view name) const
{
    if (const auto found = own_.constants.find(name); found != own_.constants.end())
        return &found->second;
    if (!outer_)
        return nullptr;
    const auto found = outer_->constants.find(name);
    return found == outer_->constants.end() ? nullptr : &found->second;
}

std::vector<std::string> check_bindings(const Graph& graph, const ShaderLibrary& library)
{
    return BindingChecker(graph, library).run();
}

} // namespace graph
