#include "passes/frame.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "passes/chang.hpp"
#include "passes/diffusion.hpp"
#include "passes/screen_diffusion.hpp"
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

/// The light on the skin, as far as the frame wants it. Its shadows are those of the whole head, wherever the
/// camera is: they stand as the light does.
struct OnSkin
{
    std::optional<SkinLight> kept;
    std::optional<DiffusedLight> around;
    std::optional<SkinSamples> samples;
    Shadows shadows;
    graph::ImageId shadow_depth;
};

OnSkin add_light_on_skin(graph::Graph& graph, const FrameInput& input, ForwardInput on_skin)
{
    const bool received = input.shading.on_atlas() && input.diffusion_scale && input.shading.lambertian();
    OnSkin result;
    if (!input.skin || (!input.kept_scale && !received))
        return result;
    if (input.shading.shadow)
        on_skin.shadows = fit_shadows(on_skin.lights, input.head.min, input.head.max, {}, kept_shadow_size);
    const bool kept = input.kept_scale && can_keep_light(input.shading, on_skin.shadows);
    if (!kept && !received)
        return result;
    if (on_skin.shadows.casting != 0)
        on_skin.shadow_depth = add_shadows(graph, "skin shadow", on_skin.shadows, *input.head.caster_mesh,
                                           input.head.casters, kept_shadow_size);
    result.shadows = on_skin.shadows;
    result.shadow_depth = on_skin.shadow_depth;
    if (received && input.shading.transport == optics::Transport::Chang)
        result.samples = add_skin_samples(graph, on_skin, *input.skin, *input.diffusion_scale, input.shading);
    else if (received)
        result.around = add_diffusion(graph, on_skin, *input.skin, *input.diffusion_scale, input.shading);
    on_skin.around = result.around ? &*result.around : nullptr;
    if (kept)
        result.kept.emplace(add_skin_light(graph, on_skin, *input.skin, *input.kept_scale, input.shading,
                                           input.exposure_stops));
    return result;
}

/// The first wound with the tissue of the i-th.
std::size_t first_of_tissue(std::span<const FrameWound> wounds, std::size_t i)
{
    std::size_t first = 0;
    while (&wounds[first].tissue != &wounds[i].tissue)
        ++first;
    return first;
}

/// The skin's light spreads; without `samples` (the head has no atlas) transport `chang` is drawn as
/// `burley`.
graph::ImageId spread_in_picture(graph::Graph& graph, const FrameInput& input, const ForwardImages& drawn,
                                 const std::optional<SkinSamples>& samples)
{
    const bool sampled = input.shading.transport == optics::Transport::Chang && samples;
    const ScreenDiffusion diffusion =
        screen_diffusion(input.camera, input.tile, input.head, input.tissue, input.shading.transport);
    return sampled ? add_chang(graph, drawn, diffusion, *samples,
                               chang_view(input.camera, input.tile, input.tissue))
                   : add_screen_diffusion(graph, drawn, diffusion);
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
        const WoundTexture texture = add_wound_texture(graph, suffix, wound.maps, wound.today, wound.warps);
        const std::size_t first = first_of_tissue(input.wounds, i);
        const ReflectanceLut lut = first < i ? placed[first].lut
                                             : add_reflectance_lut(graph, "reflectance_lut" + suffix,
                                                                   wound.tissue, input.reflectance);
        placed.push_back(
            {wound.anchor, texture, lut, wound.tissue.parameters.axes, &wound.today, std::uint32_t(i)});
        images.wounds.push_back(texture);
        // The graph drops the passes of a wound that the picture does not sample, unless something else needs
        // their images: labels, and the measurement of areas.
        if (may_show(input.head.wounded[i], view.clip_from_world, input.tile.size))
            seen.push_back(placed.back());
    }
    std::vector<optics::Light> lights;
    std::ranges::copy_if(input.lights, std::back_inserter(lights),
                         [](const optics::Light& light) { return light.strength != base::Color(0, 0, 0); });
    ForwardInput forward{
        input.head, seen, lights, {}, {}, input.every_frame, input.tissue.scattering_length_mm};
    const bool lit = input.shading.lambertian() || input.shading.glossy();
    ForwardInput all = forward;
    all.wounds = placed;
    const OnSkin on_skin = add_light_on_skin(graph, input, all);
    forward.skin = input.skin;
    forward.placed = placed;
    forward.kept = on_skin.kept ? &*on_skin.kept : nullptr;
    forward.around = on_skin.around ? &*on_skin.around : nullptr;
    if (on_skin.kept) {
        forward.shadows = on_skin.shadows;
        forward.shadow_depth = on_skin.shadow_depth;
    } else if (input.shading.shadow && lit) {
        forward.shadows =
            fit_shadows(lights, input.head.min, input.head.max, boxes_in_picture(input), shadow_size);
        if (forward.shadows.casting != 0)
            forward.shadow_depth =
                add_shadows(graph, "shadow", forward.shadows, *input.head.caster_mesh, input.head.casters);
    }
    const Backdrop backdrop = backdrop_of(input.tile);
    forward.apart = input.shading.in_picture() && input.shading.lambertian();
    if (!forward.apart && !input.radiance && input.samples == 1 && !backdrop.transparent &&
        std::ranges::none_of(input.head.parts, &HeadPart::blend))
        forward.developed = {std::exp2(input.exposure_stops), glm::vec2(width, height), backdrop.top,
                             backdrop.bottom};
    const ForwardImages drawn = add_forward(graph, forward, view, input.shading,
                                            {width, height, VK_FORMAT_R16G16B16A16_SFLOAT, input.samples});
    if (forward.developed)
        images.picture = drawn.radiance;
    else {
        images.radiance =
            drawn.apart ? spread_in_picture(graph, input, drawn, on_skin.samples) : drawn.radiance;
        images.picture =
            add_tonemap(graph, images.radiance, input.exposure_stops, Highlights::SoftShoulder, backdrop);
    }
    images.labels =
        add_labels(graph, input.head, placed, view, label_camera(input.camera, input.tile), input.tile.size);
    return images;
}

} // namespace passes
