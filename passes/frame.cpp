#include "passes/frame.hpp"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <iterator>

#include "passes/shadow.hpp"
#include "passes/tonemap.hpp"

namespace passes {
namespace {

/// Of the whole picture, so that all its tiles have the same shadow maps.
std::vector<Bounds> boxes_in_picture(const FrameInput& input)
{
    const shared::View whole = make_view(input.camera, input.head, ViewportTile(input.tile.picture));
    return boxes_in_view(input.head.boxes, whole.clip_from_world);
}

} // namespace

FrameImages add_frame(graph::Graph& graph, const FrameInput& input)
{
    assert(input.wounds.size() == input.head.wounded.size());
    const auto [width, height] = input.tile.size;
    const shared::View view = make_view(input.camera, input.head, input.tile);
    FrameImages images;
    std::vector<ForwardWound> placed, seen;
    for (std::size_t i = 0; i < input.wounds.size(); ++i) {
        const FrameWound& wound = input.wounds[i];
        const std::string suffix = i == 0 ? "" : fmt::format(" {}", i + 1);
        const WoundTexture texture = add_wound_texture(graph, suffix, wound.maps, wound.today);
        const ReflectanceLut lut =
            add_reflectance_lut(graph, "reflectance_lut" + suffix, wound.tissue, input.reflectance);
        placed.push_back({wound.anchor, texture, lut, wound.tissue.parameters.axes, &wound.today});
        images.wounds.push_back(texture);
        // The graph drops the passes of a wound that the picture does not sample, unless something else needs
        // their images: labels, and the measurement of areas.
        if (may_show(input.head.wounded[i], view.clip_from_world, input.tile.size))
            seen.push_back(placed.back());
    }
    std::vector<optics::Light> lights;
    std::ranges::copy_if(input.lights, std::back_inserter(lights),
                         [](const optics::Light& light) { return light.strength != base::Color(0, 0, 0); });
    ForwardInput forward{input.head, seen, lights, {}, {}, input.every_frame, input.scattering_length_mm};
    if (input.shading.shadow && (input.shading.lambertian() || input.shading.glossy()))
        forward.shadows = fit_shadows(lights, input.head.min, input.head.max, boxes_in_picture(input));
    if (forward.shadows.casting != 0)
        forward.shadow_depth =
            add_shadows(graph, forward.shadows, *input.head.caster_mesh, input.head.casters);
    images.radiance = add_forward(graph, forward, view, input.shading,
                                  {width, height, VK_FORMAT_R16G16B16A16_SFLOAT, input.samples});
    images.picture = add_tonemap(graph, images.radiance, input.exposure_stops, Highlights::SoftShoulder,
                                 backdrop_of(input.tile));
    images.labels =
        add_labels(graph, input.head, placed, view, label_camera(input.camera, input.tile), input.tile.size);
    return images;
}

} // namespace passes
