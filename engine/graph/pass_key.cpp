#include "engine/graph/pass_key.hpp"

#include "base/hash.hpp"

#include <fmt/format.h>
#include <map>

namespace graph {

namespace {

void add_bindings(std::vector<KeyPart>& key, const std::string& prefix, const Bindings& bindings)
{
    for (const auto& [name, value] : bindings.constants) {
        base::Hash hash;
        hash.add(value.index());
        std::visit([&](auto v) { hash.add(v); }, value);
        key.push_back({prefix + "constant " + name, hash.value()});
    }
    for (const Bindings::Data& data : bindings.data)
        key.push_back({prefix + (data.storage ? "buffer " : "uniform ") + data.name, data.bytes.hash()});
    for (const Bindings::Stored& stored : bindings.stored)
        key.push_back({prefix + "stored " + stored.name, base::Hash().add(stored.image.index).value()});
}

void add_draw(std::vector<KeyPart>& key, const std::string& prefix, const Draw& draw)
{
    base::Hash hash;
    hash.add(draw.shader)
        .add(draw.mesh ? draw.mesh->content() : 0)
        .add(draw.first_index)
        .add(draw.index_count);
    hash.add(draw.cull_back_faces).add(draw.blend).add(draw.depth_test).add(draw.depth_write);
    key.push_back({prefix + "draw", hash.value()});
    add_bindings(key, prefix, draw);
}

/// The key of a pass without its images.
std::vector<KeyPart> declared_key(const Pass& pass)
{
    std::vector<KeyPart> key;
    if (const auto* compute = std::get_if<ComputePass>(&pass)) {
        key.push_back({"shader", base::Hash().add(compute->shader).value()});
        key.push_back({"dispatch", base::Hash().add(compute->width).add(compute->height).value()});
        add_bindings(key, "", *compute);
        return key;
    }
    const auto& raster = std::get<RasterPass>(pass);
    base::Hash targets;
    for (const RasterPass::ColorTarget& target : raster.colors) {
        targets.add(target.resolve.valid());
        for (const float channel : target.clear)
            targets.add(channel);
    }
    key.push_back({"targets", targets.add(raster.depth_image.valid()).add(raster.depth_clear).value()});
    add_bindings(key, "", raster);
    for (std::size_t i = 0; i < raster.draws.size(); ++i)
        add_draw(key, raster.draws.size() == 1 ? "" : fmt::format("draw {}: ", i), raster.draws[i]);
    return key;
}

/// Shader name, filter and images of each sampled binding; the images by their places in the pass's list.
std::uint64_t hash_of_samplers(const Pass& pass, std::span<const ImageAccess> accesses, std::size_t images)
{
    std::vector<std::uint32_t> places(images);
    for (std::uint32_t i = 0; i < accesses.size(); ++i)
        places[accesses[i].image.index] = i;
    base::Hash hash;
    const auto add = [&](const Bindings& bindings) {
        for (const Bindings::Sampled& sampled : bindings.sampled) {
            hash.add(sampled.name).add(sampled.sampler).add(sampled.images.size());
            for (const ImageId id : sampled.images)
                hash.add(places[id.index]);
        }
    };
    if (const auto* raster = std::get_if<RasterPass>(&pass)) {
        add(*raster);
        for (const Draw& draw : raster->draws)
            add(draw);
    } else
        add(std::get<ComputePass>(pass));
    return hash.value();
}

void confine(KeyPart& part, const Reach::Confined& input)
{
    part.region = input.region;
    part.source = input.source;
    part.in_place = !input.region;
}

/// The last word about each image.
std::map<std::uint32_t, const Reach::Confined*> confined_images(const Reach& reach)
{
    std::map<std::uint32_t, const Reach::Confined*> images;
    for (const Reach::Confined& input : reach.confined)
        if (input.image.valid())
            images[input.image.index] = &input;
    return images;
}

/// Of the blocks of the pass or its draws.
void confine_blocks(std::vector<KeyPart>& key, const Reach& reach)
{
    for (const Reach::Confined& input : reach.confined) {
        if (input.image.valid())
            continue;
        const std::string uniform = "uniform " + input.block, buffer = "buffer " + input.block;
        for (KeyPart& part : key)
            if (part.what.ends_with(uniform) || part.what.ends_with(buffer))
                confine(part, input);
    }
}

} // namespace

std::vector<KeyPart> pass_key(const Graph& graph, const Pass& pass, std::span<const ImageAccess> accesses,
                              std::span<const std::uint64_t> content_versions)
{
    const Reach& reach = std::visit([](const Reach& of_pass) -> const Reach& { return of_pass; }, pass);
    std::vector<KeyPart> key = declared_key(pass);
    confine_blocks(key, reach);
    const auto confined = confined_images(reach);
    for (const ImageAccess& access : accesses) {
        const auto& [name, desc, external] = graph.images[access.image.index];
        if (access_row(access.usage).writes) {
            key.push_back(
                {"size of " + name,
                 base::Hash().add(desc.width).add(desc.height).add(desc.format).add(desc.samples).value()});
            continue;
        }
        key.push_back({"input " + name, content_versions[access.image.index]});
        if (const auto found = confined.find(access.image.index); found != confined.end())
            confine(key.back(), *found->second);
    }
    key.push_back({"samplers", hash_of_samplers(pass, accesses, graph.images.size())});
    return key;
}

} // namespace graph
