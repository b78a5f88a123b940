#include "passes/wound_texture.hpp"

#include "shaders/shared/wound.h"
#include "wound/day_maps.hpp"

namespace passes {

WoundMaps upload_wound(const gpu::Device& device, const wound::Patch& patch)
{
    cv::Mat half_color, half_shape; // every device can filter half floats
    wound::day0_color(patch).convertTo(half_color, CV_16F);
    wound::day0_shape(patch).convertTo(half_shape, CV_16F);

    WoundMaps maps;
    maps.color =
        std::make_shared<const gpu::Texture>(device, half_color, gpu::Encoding::Linear, true, "day 0 color");
    maps.shape =
        std::make_shared<const gpu::Texture>(device, half_shape, gpu::Encoding::Linear, true, "day 0 shape");
    maps.bed_luminance = wound::bed_luminance(patch);
    maps.width_mm = patch.width_mm;
    maps.size = patch.color.cols;
    maps.region = cv::Rect({}, patch.color.size());
    return maps;
}

PackedWarps pack_warps(const wound::WoundDay& today)
{
    std::vector<shared::vec2> values;
    const shared::WarpHeader border = wound::pack(today.border_warp, values),
                             bed = wound::pack(today.bed_warp, values);
    return {border, bed, graph::Bytes::of(values)};
}

WoundTexture add_wound_texture(graph::Graph& graph, const std::string& suffix, const WoundMaps& maps,
                               const wound::WoundDay& today, const PackedWarps& warps)
{
    const auto width = std::uint32_t(maps.region.width), height = std::uint32_t(maps.region.height);
    const graph::ImageDesc desc{width, height, VK_FORMAT_R16G16B16A16_SFLOAT};
    const glm::dvec2 extent(maps.region.width, maps.region.height), begin(maps.region.x, maps.region.y);
    const WoundTexture texture{
        graph.image("wound_color" + suffix, desc), graph.image("wound_state" + suffix, desc),
        graph.image("wound_relief" + suffix, desc), shared::vec2(0.5 * maps.size / extent),
        shared::vec2((0.5 * maps.size - begin) / extent)};

    shared::WoundToday params{};
    params.border = warps.border;
    params.bed = warps.bed;
    params.first_texel = {maps.region.x, maps.region.y};
    params.border_softness = float(today.border_softness);
    params.bed_presence = float(today.bed_presence);
    params.phase = {float(today.phase.clot), float(today.phase.fibrin), float(today.phase.granulation),
                    float(today.phase.rim), float(maps.bed_luminance)};

    graph::ComputePass& warp = graph.compute("wound_texture" + suffix, "wound_texture.comp");
    warp.constant("WARP_MODEL", std::uint32_t(today.border_warp.model));
    warp.constant("BED_APART", today.unhealed_ratio != today.border_ratio);
    warp.constant("PHASES", today.in_phases);
    warp.sample("day0_color", graph.import("day0_color" + suffix, *maps.color),
                graph::Sampler::LinearClampMips);
    warp.sample("day0_shape", graph.import("day0_shape" + suffix, *maps.shape),
                graph::Sampler::LinearClampMips);
    warp.store("color", texture.color);
    warp.store("state", texture.state);
    warp.uniform("Today_", params);
    warp.buffer("WarpValues_", warps.values);
    warp.dispatch(width, height);

    graph::ComputePass& relief = graph.compute("wound_relief" + suffix, "wound_relief.comp");
    relief.sample("state", texture.state);
    relief.sample("color", texture.color);
    relief.store("relief", texture.relief);
    relief.uniform("Relief_", wound::relief_parameters(today, maps.width_mm / maps.size));
    relief.dispatch(width, height);
    return texture;
}

} // namespace passes
