// Transport `chang`: C.-W. Chang, W.-C. Lin, T.-C. Ho et al. 2008, "Real-time translucent rendering using
// GPU-based texture space importance sampling" (Computer Graphics Forum 27). The light that the skin receives
// stands on its atlas; a pyramid of its importance gives a few hundred samples, the same for all pixels, and
// each pixel of the picture adds up the dipole's light from all of them. Light from nearby, which they would
// miss, is gathered in the picture.
#pragma once
#include "passes/screen_diffusion.hpp"
#include "passes/skin.hpp"
#include "shaders/shared/chang.h"

namespace passes {

/// shared::CHANG_SAMPLES x 1 texels, RGBA32F.
struct SkinSamples
{
    graph::ImageId places; // mm
    graph::ImageId lights; // mm^2 x light per reflectance: E A / (N p)
};

/// `input` as for add_skin_light(), `scale` by diffusion_scale().
SkinSamples add_skin_samples(graph::Graph& graph, const ForwardInput& input, const Skin& skin, double scale,
                             const optics::Shading& shading);

/// As add_screen_diffusion() does. `camera`, `tile`: of the picture.
graph::ImageId add_chang(graph::Graph& graph, const ForwardImages& drawn, const ScreenDiffusion& diffusion,
                         const SkinSamples& samples, const shared::ChangView& view);
shared::ChangView chang_view(const head::Camera& camera, const ViewportTile& tile,
                             const optics::TissueSpread& tissue);

} // namespace passes
