#include "engine/graph/graph.hpp"

#include "base/hash.hpp"

#include <algorithm>
#include <utility>

namespace graph {

namespace {

/// Adds `value`, or replaces the entry of the same name.
template <typename Named>
void add_or_replace(std::vector<Named>& list, Named value)
{
    const auto same =
        std::find_if(list.begin(), list.end(), [&](const Named& other) { return other.name == value.name; });
    if (same != list.end())
        *same = std::move(value);
    else
        list.push_back(std::move(value));
}

} // namespace

Bytes::Bytes(std::span<const std::byte> value)
    : bytes_(std::make_shared<const std::vector<std::byte>>(value.begin(), value.end())),
      hash_(base::Hash().add(value).value())
{
}

void Bindings::sample(std::string_view name, ImageId image, Sampler sampler)
{
    sample(name, std::span(&image, 1), sampler);
}

void Bindings::sample(std::string_view name, std::span<const ImageId> images, Sampler sampler)
{
    add_or_replace(sampled, Sampled{std::string(name), {images.begin(), images.end()}, sampler});
}

void Bindings::store(std::string_view name, ImageId image)
{
    add_or_replace(stored, Stored{std::string(name), image});
}

void Bindings::constant(std::string_view name, Constant value)
{
    constants.insert_or_assign(std::string(name), value);
}

void Bindings::set(std::string_view name, const Bytes& value, bool storage)
{
    add_or_replace(data, Data{std::string(name), value, storage});
}

void ComputePass::dispatch(std::uint32_t invocations_x, std::uint32_t invocations_y)
{
    width = invocations_x;
    height = invocations_y;
}

void RasterPass::color(ImageId image, std::array<float, 4> clear, ImageId resolve)
{
    colors.push_back({image, resolve, clear});
}

void RasterPass::depth(ImageId image, float clear)
{
    depth_image = image;
    depth_clear = clear;
}

Draw& RasterPass::draw(std::string_view shader)
{
    Draw& added = draws.emplace_back();
    added.shader = shader;
    return added;
}

ImageId Graph::image(std::string_view name, const ImageDesc& desc)
{
    images.push_back({name_prefix_ + std::string(name), desc, {}});
    return {static_cast<std::uint32_t>(images.size() - 1)};
}

ImageId Graph::import(std::string_view name, const ExternalImage& external)
{
    for (auto i = static_cast<std::uint32_t>(images.size()); i-- > 0;) // most often one of the latest
        if (images[i].external && images[i].external->content == external.content &&
            images[i].name == name_prefix_ + std::string(name))
            return {i};
    images.push_back({name_prefix_ + std::string(name), external.desc, external});
    return {static_cast<std::uint32_t>(images.size() - 1)};
}

ComputePass& Graph::compute(std::string_view name, std::string_view shader)
{
    ComputePass pass;
    pass.name = name_prefix_ + std::string(name);
    pass.shader = shader;
    return std::get<ComputePass>(passes.emplace_back(std::move(pass)));
}

RasterPass& Graph::raster(std::string_view name)
{
    RasterPass pass;
    pass.name = name_prefix_ + std::string(name);
    return std::get<RasterPass>(passes.emplace_back(std::move(pass)));
}

ReadbackId Graph::readback(std::string_view name, ImageId image)
{
    readbacks.push_back({std::string(name), image});
    return {static_cast<std::uint32_t>(readbacks.size() - 1)};
}

void Graph::present(ImageId image)
{
    presented.push_back(image);
}

const std::string& name_of(const Pass& pass)
{
    return std::visit([](const auto& p) -> const std::string& { return p.name; }, pass);
}

} // namespace graph
