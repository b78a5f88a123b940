#include "passes/part_bindings.hpp"

#include <fmt/format.h>

#include "wound/optics/specular.hpp"

namespace passes {
namespace {

/// Binds every wound sampler of the shader; unused ones get the head's white texel.
void bind_wounds(graph::Draw& draw, std::span<const ForwardWound> wounds, graph::ImageId blank)
{
    std::vector<graph::ImageId> color(shared::MAX_WOUNDS, blank), state = color, relief = color, lut = color;
    for (std::size_t i = 0; i < wounds.size(); ++i) {
        color[i] = wounds[i].texture.color;
        state[i] = wounds[i].texture.state;
        relief[i] = wounds[i].texture.relief;
        lut[i] = wounds[i].lut.reflectance;
    }
    draw.constant("WOUNDS", std::uint32_t(wounds.size()));
    draw.uniform("Wounds_", wound_frames(wounds));
    draw.sample("wound_color", color);
    draw.sample("wound_state", state);
    draw.sample("wound_relief", relief);
    draw.sample("reflectance_lut", lut);
}

} // namespace

shared::Part part_params(const HeadPart& part, optics::Shading shading)
{
    const head::Gloss gloss = head::gloss_of(part.surface);
    shading.alpha_x *= gloss.slope;
    shading.alpha_y *= gloss.slope;
    return {.albedo_factor = part.albedo_factor,
            .normal_scale = part.normal_scale,
            .specular = float(gloss.specular),
            .slope = float(gloss.slope),
            .grazing = float(optics::grazing_reflectance(shading)),
            .translucency = part.surface == head::Surface::Eye ? 0.5f : 1.f,
            .scattering = part.surface == head::Surface::Skin ? 1.f : 0.f};
}

void bind_part(graph::Graph& graph, graph::Draw& draw, const Head& head, const HeadPart& part,
               std::uint32_t set, std::span<const ForwardWound> wounds, bool occlusion)
{
    const auto map = [&](const char* name, const char* image, const gpu::Texture& texture) {
        draw.sample(name, graph.import(fmt::format("{} {}", image, part.material), texture),
                    graph::Sampler::LinearRepeatMips);
    };
    map("albedo_map", "albedo", *part.albedo);
    map("normal_map", "normal", *part.normal);
    if (occlusion) {
        map("occlusion_map", "occlusion", *part.occlusion);
        draw.constant("OCCLUSION_MAP", part.occlusion != head.white);
    }
    std::vector<ForwardWound> showing;
    for (const ForwardWound& wound : wounds)
        if ((set >> wound.index & 1) != 0)
            showing.push_back(wound);
    bind_wounds(draw, showing, graph.import("white", *head.white));
}

} // namespace passes
