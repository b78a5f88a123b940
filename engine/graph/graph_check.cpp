#include "engine/graph/graph_check.hpp"

#include "engine/graph/formats.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>
#include <stdexcept>

namespace graph {

namespace {

/// Collects the mistakes of one graph.
class GraphChecker
{
  public:
    explicit GraphChecker(const Graph& graph) : graph_(graph), writers_(graph.images.size()) {}

    std::vector<std::string> run()
    {
        check_images();
        check_names();
        for (const Pass& pass : graph_.passes)
            for (const ImageAccess& access : accesses(pass))
                if (access_row(access.usage).writes && known(access.image))
                    writers_[access.image.index].push_back(name_of(pass));
        for (const Pass& pass : graph_.passes) {
            check_accesses(pass);
            std::visit([&](const auto& p) { check_pass(p); }, pass);
            check_reach(pass);
        }
        check_writers();
        check_outputs();
        check_cycles();
        return std::move(lines_);
    }

  private:
    template <typename... Args>
    void complain(fmt::format_string<Args...> format, Args&&... args)
    {
        lines_.push_back(fmt::format(format, std::forward<Args>(args)...));
    }

    bool known(ImageId id) const { return id.index < graph_.images.size(); }
    const Graph::Image& image(ImageId id) const { return graph_.images[id.index]; }
    std::string image_name(ImageId id) const
    {
        return known(id) ? image(id).name : "an image that is not declared";
    }

    void check_images()
    {
        std::set<std::string> names;
        for (const Graph::Image& image : graph_.images) {
            if (image.name.empty())
                complain("image without a name");
            if (!names.insert(image.name).second)
                complain("image {}: declared twice", image.name);
            if (image.desc.width == 0 || image.desc.height == 0)
                complain("image {}: its size is {} x {}", image.name, image.desc.width, image.desc.height);
            if (!find_format(image.desc.format))
                complain("image {}: its format is not one of engine/graph/formats.cpp", image.name);
            if (image.desc.samples != 1 && image.desc.samples != 4)
                complain("image {}: {} samples; only 1 and 4 are possible", image.name, image.desc.samples);
        }
    }

    void check_names()
    {
        std::set<std::string> names;
        for (const Pass& pass : graph_.passes) {
            if (name_of(pass).empty())
                complain("pass without a name");
            if (!names.insert(name_of(pass)).second)
                complain("pass {}: declared twice", name_of(pass));
        }
    }

    void check_accesses(const Pass& pass)
    {
        const std::string& name = name_of(pass);
        std::set<std::uint32_t> read;
        for (const auto& [id, usage] : accesses(pass)) {
            if (!known(id)) {
                complain("pass {}: uses {}", name, image_name(id));
                continue;
            }
            const Graph::Image& used = image(id);
            const bool depth = is_depth(used.desc.format);
            if (!access_row(usage).writes) {
                read.insert(id.index);
                if (!used.external && writers_[id.index].empty())
                    complain("pass {}: samples {}, which no pass writes", name, used.name);
                if (used.desc.samples != 1)
                    complain("pass {}: samples {}, which is multisampled; resolve it first", name, used.name);
                continue;
            }
            if (used.external)
                complain("pass {}: writes {}, which is imported", name, used.name);
            if (read.contains(id.index))
                complain("pass {}: samples {}, which it also writes", name, used.name);
            if (depth != (usage == Usage::Depth))
                complain("pass {}: uses {} as {}, which its {} format does not allow", name, used.name,
                         access_row(usage).name, depth ? "depth" : "colour");
        }
    }

    /// Vulkan does not require devices to filter depth formats.
    void check_samplers(const std::string& pass, const Bindings& bindings)
    {
        for (const Bindings::Sampled& sampled : bindings.sampled)
            for (const ImageId id : sampled.images)
                if (known(id) && is_depth(image(id).desc.format) && sampled.sampler != Sampler::NearestClamp)
                    complain("pass {}: samples {} with a filter, which its depth format does not allow; "
                             "NearestClamp does",
                             pass, image_name(id));
    }

    void check_pass(const ComputePass& pass)
    {
        check_samplers(pass.name, pass);
        if (pass.stored.empty())
            complain("pass {}: stores to no image", pass.name);
        if (pass.width == 0 || pass.height == 0)
            complain("pass {}: dispatches {} x {} invocations", pass.name, pass.width, pass.height);
        for (const Bindings::Stored& stored : pass.stored)
            if (known(stored.image) && image(stored.image).desc.samples != 1)
                complain("pass {}: stores to {}, which is multisampled", pass.name, image_name(stored.image));
    }

    void check_pass(const RasterPass& pass)
    {
        if (pass.colors.empty() && !pass.depth_image.valid())
            complain("pass {}: has no target", pass.name);
        if (pass.draws.empty())
            complain("pass {}: draws nothing", pass.name);
        check_samplers(pass.name, pass);
        for (const Draw& draw : pass.draws) {
            check_samplers(pass.name, draw);
            if (!draw.mesh && draw.index_count == 0)
                complain("pass {}: draw {} has neither a mesh nor a number of vertices", pass.name,
                         draw.shader);
            if (!draw.stored.empty())
                complain("pass {}: draw {} stores to an image; only a compute pass can", pass.name,
                         draw.shader);
        }
        if (!pass.stored.empty())
            complain("pass {}: stores to an image; only a compute pass can", pass.name);
        check_targets(pass);
    }

    /// A region is one of all images that the pass writes.
    void check_reach(const Pass& pass)
    {
        const auto& confined = std::visit(
            [](const Reach& reach) -> const auto& { return reach.confined; }, pass);
        if (confined.empty())
            return;
        std::vector<ImageDesc> outputs;
        std::set<std::uint32_t> read;
        for (const auto& [id, usage] : accesses(pass))
            if (known(id)) {
                if (access_row(usage).writes)
                    outputs.push_back(image(id).desc);
                else
                    read.insert(id.index);
            }
        for (const ImageDesc& desc : outputs)
            if (desc.width != outputs.front().width || desc.height != outputs.front().height)
                complain("pass {}: confines a change to a region, but writes images of several sizes",
                         name_of(pass));
        std::set<std::string> seen;
        for (const Reach::Confined& input : confined) {
            bool block = std::visit(
                [&](const Bindings& bindings) { return find_named(bindings.data, input.block) != nullptr; },
                pass);
            if (const auto* raster = std::get_if<RasterPass>(&pass))
                block |= std::ranges::any_of(raster->draws, [&](const Draw& draw) {
                    return find_named(draw.data, input.block) != nullptr;
                });
            const std::string name = input.block.empty() ? image_name(input.image) : input.block;
            if (!seen.insert(name).second)
                complain("pass {}: confines changes of {} twice", name_of(pass), name);
            if (input.block.empty() ? !read.contains(input.image.index) : !block)
                complain("pass {}: confines changes of {}, which it does not read", name_of(pass), name);
            if (!input.region && known(input.image))
                for (const ImageDesc& desc : outputs)
                    if (desc.width != image(input.image).desc.width ||
                        desc.height != image(input.image).desc.height)
                        complain("pass {}: works in place on {}, which is not of its images' size",
                                 name_of(pass), name);
            for (const ImageDesc& desc : outputs)
                if (input.region && (input.region->x + input.region->width > desc.width ||
                                     input.region->y + input.region->height > desc.height))
                    complain("pass {}: confines changes of {} to a region beyond its images", name_of(pass),
                             name);
        }
    }

    void check_targets(const RasterPass& pass)
    {
        std::optional<ImageDesc> common;
        const auto same = [&](ImageId id) {
            if (!known(id))
                return; // check_accesses reports it
            const ImageDesc& desc = image(id).desc;
            if (!common)
                common = desc;
            if (desc.width != common->width || desc.height != common->height)
                complain("pass {}: {} is {} x {}, its other targets are {} x {}", pass.name, image_name(id),
                         desc.width, desc.height, common->width, common->height);
            if (desc.samples != common->samples)
                complain("pass {}: {} has {} samples, its other targets have {}", pass.name, image_name(id),
                         desc.samples, common->samples);
        };
        for (const RasterPass::ColorTarget& target : pass.colors)
            same(target.image);
        if (pass.depth_image.valid())
            same(pass.depth_image);
        for (const RasterPass::ColorTarget& target : pass.colors)
            if (target.resolve.valid() && known(target.resolve) && known(target.image))
                check_resolve(pass.name, target);
    }

    void check_resolve(const std::string& pass, const RasterPass::ColorTarget& target)
    {
        const ImageDesc& from = image(target.image).desc;
        ImageDesc expected = from;
        expected.samples = 1;
        if (from.samples == 1)
            complain("pass {}: {} is resolved but not multisampled", pass, image_name(target.image));
        if (image(target.resolve).desc != expected)
            complain(
                "pass {}: {} cannot take the resolve of {}: same size and format and 1 sample are needed",
                pass, image_name(target.resolve), image_name(target.image));
    }

    void check_writers()
    {
        for (std::size_t i = 0; i < writers_.size(); ++i)
            if (writers_[i].size() > 1)
                complain("pass {}: writes {}, which pass {} writes too", writers_[i][1],
                         graph_.images[i].name, writers_[i][0]);
    }

    void check_outputs()
    {
        std::set<std::string> names;
        for (const Graph::Readback& readback : graph_.readbacks) {
            if (!names.insert(readback.name).second)
                complain("readback {}: declared twice", readback.name);
            check_output("readback " + readback.name, readback.image);
        }
        for (const ImageId id : graph_.presented)
            check_output("present", id);
    }

    void check_output(const std::string& who, ImageId id)
    {
        if (!known(id))
            complain("{}: uses {}", who, image_name(id));
        else if (image(id).external)
            complain("{}: uses {}, which is imported", who, image_name(id));
        else if (writers_[id.index].empty())
            complain("{}: uses {}, which no pass writes", who, image_name(id));
        else if (image(id).desc.samples != 1)
            complain("{}: uses {}, which is multisampled", who, image_name(id));
    }

    void check_cycles()
    {
        const std::vector<std::uint32_t> order = order_passes(graph_);
        std::vector<std::string> stuck;
        for (std::uint32_t i = 0; i < graph_.passes.size(); ++i)
            if (std::find(order.begin(), order.end(), i) == order.end())
                stuck.push_back(name_of(graph_.passes[i]));
        if (!stuck.empty())
            complain("pass {}: no order is possible, these passes need each other's images: {}",
                     stuck.front(), fmt::join(stuck, ", "));
    }

    const Graph& graph_;
    std::vector<std::vector<std::string>> writers_; // by image: names of passes
    std::vector<std::string> lines_;
};

/// Appends each image once: many draws may sample the same ones. `seen`: by image.
void add_sampled(std::vector<ImageAccess>& list, std::vector<bool>& seen, const Bindings& bindings,
                 Usage usage)
{
    constexpr std::uint32_t most = 1 << 16; // beyond it an id is a mistake, which the check reports
    for (const Bindings::Sampled& sampled : bindings.sampled)
        for (const ImageId id : sampled.images) {
            if (id.index < most) {
                seen.resize(std::max<std::size_t>(seen.size(), id.index + 1));
                if (seen[id.index])
                    continue;
                seen[id.index] = true;
            }
            list.push_back({id, usage});
        }
}

} // namespace

std::vector<ImageAccess> accesses(const Pass& pass)
{
    std::vector<ImageAccess> list;
    std::vector<bool> seen;
    if (const auto* compute = std::get_if<ComputePass>(&pass)) {
        add_sampled(list, seen, *compute, Usage::SampledInCompute);
        for (const Bindings::Stored& stored : compute->stored)
            list.push_back({stored.image, Usage::Stored});
        return list;
    }
    const auto& raster = std::get<RasterPass>(pass);
    add_sampled(list, seen, raster, Usage::SampledInRaster);
    for (const Draw& draw : raster.draws)
        add_sampled(list, seen, draw, Usage::SampledInRaster);
    for (const RasterPass::ColorTarget& target : raster.colors) {
        list.push_back({target.image, Usage::Color});
        if (target.resolve.valid())
            list.push_back({target.resolve, Usage::Color});
    }
    if (raster.depth_image.valid())
        list.push_back({raster.depth_image, Usage::Depth});
    return list;
}

std::vector<std::string> check_graph(const Graph& graph)
{
    return GraphChecker(graph).run();
}

std::vector<std::uint32_t> order_passes(const Graph& graph)
{
    const auto count = static_cast<std::uint32_t>(graph.passes.size());
    std::vector<std::vector<ImageAccess>> touched(count);
    std::map<std::uint32_t, std::set<std::uint32_t>> unwritten; // image -> its writers not yet in the order
    for (std::uint32_t i = 0; i < count; ++i) {
        touched[i] = accesses(graph.passes[i]);
        for (const ImageAccess& access : touched[i])
            if (access_row(access.usage).writes)
                unwritten[access.image.index].insert(i);
    }
    const auto ready = [&](std::uint32_t pass) {
        return std::all_of(touched[pass].begin(), touched[pass].end(), [&](const ImageAccess& access) {
            const auto writers = unwritten.find(access.image.index);
            return access_row(access.usage).writes || writers == unwritten.end() || writers->second.empty() ||
                   writers->second.contains(pass);
        });
    };
    std::vector<std::uint32_t> order;
    std::vector<bool> done(count);
    for (bool progress = true; progress;) {
        progress = false;
        for (std::uint32_t i = 0; i < count && !progress; ++i) {
            if (done[i] || !ready(i))
                continue;
            done[i] = progress = true; // restart at the first pass, to keep the declared order
            order.push_back(i);
            for (const ImageAccess& access : touched[i])
                if (access_row(access.usage).writes)
                    unwritten[access.image.index].erase(i);
        }
    }
    return order;
}

void throw_if_any(const std::vector<std::string>& problems)
{
    if (!problems.empty())
        throw std::logic_error(
            fmt::format("the render graph is declared wrongly:\n  {}", fmt::join(problems, "\n  ")));
}

} // namespace graph
