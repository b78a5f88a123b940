// Light that spreads through the skin in the picture: of its neighbours a pixel knows what the camera sees.
// Transport `separable` (Jimenez et al. 2015) takes two passes, along x and y, `burley` (Golubev 2018) one.
// Both cost what the picture's skin costs, in every frame in which the camera, the light or the day has
// changed it.
#pragma once
#include "passes/forward.hpp"
#include "shaders/shared/screen_diffusion.h"
#include "wound/optics/transport.hpp"

namespace passes {

struct ScreenDiffusion
{
    optics::Transport transport = optics::Transport::Separable; // in_picture()
    shared::PictureTile tile;
    optics::TissueSpread tissue; // of the skin
    std::uint32_t reach = 0;     // pixels: a pixel's light spreads less far; even
};

/// For a tile of the camera's picture. Without an apron as wide as ScreenDiffusion::reach a tile shows a
/// seam.
ScreenDiffusion screen_diffusion(const head::Camera& camera, const ViewportTile& tile, const Head& head,
                                 const optics::TissueSpread& tissue, optics::Transport transport);

/// `drawn`: with `apart`. Returns the radiance, as add_forward() does.
graph::ImageId add_screen_diffusion(graph::Graph& graph, const ForwardImages& drawn,
                                    const ScreenDiffusion& diffusion);

} // namespace passes
