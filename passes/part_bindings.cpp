#include "passes/part_bindings.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "wound/optics/specular.hpp"

namespace passes {
namespace {

/// Binds every wound sampler of the shader; unused ones get the head's white texel.
void bind_wounds(graph::Draw& draw, std::span<const ForwardWound> wounds, graph::ImageId blank)
{
    std::vector<graph::ImageId> color(shared::WOUNDS_HERE, blank), state = color, relief = color, lut = color;
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
               const WoundSet& set, std::span<const ForwardWound> wounds)
{
    const auto map = [&](const char* name, const char* image, const gpu::Texture& texture) {
        draw.sample(name, graph.import(fmt::format("{} {}", image, part.material), texture),
                    graph::Sampler::LinearRepeatMips);
    };
    map("albedo_map", "albedo", *part.albedo);
    map("normal_map", "normal", *part.normal);
    map("occlusion_map", "occlusion", *part.occlusion);
    draw.constant("OCCLUSION_MAP", part.occlusion != head.white);
    bind_wounds(draw, of_set(set, wounds), graph.import("white", *head.white));
}

std::vector<ForwardWound> of_set(const WoundSet& set, std::span<const ForwardWound> wounds)
{
    std::vector<ForwardWound> found;
    for (const ForwardWound& wound : wounds)
        if (std::ranges::binary_search(set, wound.index))
            found.push_back(wound);
    return found;
}

} // namespace passes
