// Light that spreads through the skin from its surroundings, on the skin's atlas (transport `diffused`): what
// a point receives from farther than a texel is kept there, what comes from nearer stays with whoever shades
// the point (shaders/lib/diffusion.glsl). Runs again when the light on the skin changes; a camera does not
// concern it.
#pragma once
#include "passes/skin_light.hpp"

namespace passes {

struct DiffusedLight
{
    graph::ImageId
        light;        // rgb: the surroundings' light, per reflectance; a: mm, the radius at which they begin
    double scale = 1; // of the atlas, a power of two
    graph::Region wounded; // what a new day can change
    double reach_m = 0;    // how far from a wound it can change something
};

/// `input` as for add_skin_light(), `scale` by diffusion_scale().
DiffusedLight add_diffusion(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                            const optics::Shading& shading);

/// `scattering_mm`: shared::Diffusion::scattering_mm.
shared::Diffusion diffusion_params(const base::Color& scattering_mm);

} // namespace passes
