#include "passes/frame.hpp"

#include <fmt/format.h>

#include "passes/shadow.hpp"
#include "passes/tonemap.hpp"

namespace passes {

FrameImages add_frame(graph::Graph& graph, const FrameInput& input)
{
    FrameImages images;
    std::vector<ForwardWound> placed;
    for (std::size_t i = 0; i < input.wounds.size(); ++i) {
        const FrameWound& wound = input.wounds[i];
        const std::string suffix = i == 0 ? "" : fmt::format(" {}", i + 1);
        const WoundTexture texture = add_wound_texture(graph, suffix, wound.maps, wound.today);
        const ReflectanceLut lut =
            add_reflectance_lut(graph, "reflectance_lut" + suffix, wound.tissue, input.reflectance);
        placed.push_back({wound.anchor, texture, lut, wound.tissue.parameters.axes, &wound.today});
        images.wounds.push_back(texture);
    }
    ForwardInput forward{input.head, placed, input.lights, {}, {}, input.every_frame};
    if (input.shading.shadow)
        forward.shadows = fit_shadows(input.lights, input.head.min, input.head.max);
    if (forward.shadows.casting != 0)
        forward.shadow_depth =
            add_shadows(graph, forward.shadows, *input.head.caster_mesh, input.head.casters);
    const auto [width, height] = input.tile.size;
    const shared::View view = make_view(input.camera, input.head, input.tile);
    images.radiance = add_forward(graph, forward, view, input.shading,
                                  {width, height, VK_FORMAT_R16G16B16A16_SFLOAT, input.samples});
    images.picture = add_tonemap(graph, images.radiance, input.exposure_stops, Highlights::SoftShoulder,
                                 backdrop_of(input.tile));
    images.labels =
        add_labels(graph, input.head, placed, view, label_camera(input.camera, input.tile), input.tile.size);
    return images;
}

} // namespace passes
