#include "engine/graph/pass_work.hpp"

#include "engine/graph/formats.hpp"
#include "engine/graph/graph_check.hpp"

#include <cmath>
#include <set>

namespace graph {

namespace {

/// Bytes of the whole images that the pass writes and stores.
std::uint64_t bytes_of_images(const Graph& graph, const PassPlan& planned)
{
    const auto size = [&](ImageId id) {
        const ImageDesc& desc = graph.images[id.index].desc;
        return std::uint64_t{desc.width} * desc.height * desc.samples * find_format(desc.format)->bytes;
    };
    const Pass& pass = graph.passes[planned.pass];
    std::uint64_t bytes = 0;
    if (const auto* compute = std::get_if<ComputePass>(&pass)) {
        for (const Bindings::Stored& stored : compute->stored)
            bytes += size(stored.image);
        return bytes;
    }
    const RasterPass& raster = std::get<RasterPass>(pass);
    for (std::size_t i = 0; i < raster.colors.size(); ++i) {
        if (planned.color_stores[i] == VK_ATTACHMENT_STORE_OP_STORE)
            bytes += size(raster.colors[i].image);
        if (raster.colors[i].resolve.valid())
            bytes += size(raster.colors[i].resolve);
    }
    if (raster.depth_image.valid() && planned.depth_store == VK_ATTACHMENT_STORE_OP_STORE)
        bytes += size(raster.depth_image);
    return bytes;
}

void add_images(std::set<std::uint32_t>& images, const Bindings& bindings)
{
    for (const Bindings::Sampled& sampled : bindings.sampled)
        for (const ImageId id : sampled.images)
            images.insert(id.index);
}

std::uint64_t maps_sampled(const Pass& pass)
{
    std::set<std::uint32_t> of_pass;
    std::visit([&](const Bindings& bindings) { add_images(of_pass, bindings); }, pass);
    const auto* raster = std::get_if<RasterPass>(&pass);
    if (!raster)
        return of_pass.size();
    std::uint64_t maps = 0;
    for (const Draw& draw : raster->draws) {
        std::set<std::uint32_t> images = of_pass;
        add_images(images, draw);
        maps += images.size();
    }
    return maps;
}

/// The first image that the pass writes.
const ImageDesc& written_image(const Graph& graph, const Pass& pass)
{
    for (const ImageAccess& access : accesses(pass))
        if (access_row(access.usage).writes)
            return graph.images[access.image.index].desc;
    return graph.images.front().desc; // not reached: every pass writes an image
}

} // namespace

PassWork work_of(const Graph& graph, const PassPlan& planned)
{
    if (planned.state != PassState::Run)
        return {};
    const Pass& pass = graph.passes[planned.pass];
    const ImageDesc& desc = written_image(graph, pass);
    const std::uint64_t all = std::uint64_t{desc.width} * desc.height;
    PassWork work{.texels = planned.region ? planned.region->texels() : all};
    work.refreshed = double(work.texels) / double(all);
    work.bytes_written =
        std::uint64_t(std::llround(work.refreshed * double(bytes_of_images(graph, planned))));
    work.maps_sampled = maps_sampled(pass);
    return work;
}

double refreshed_share(const Graph& graph, const PassPlan& planned)
{
    return work_of(graph, planned).refreshed;
}

} // namespace graph
