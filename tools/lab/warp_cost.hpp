// `cicatrix-lab warps --shader`: what the wound's two compute passes cost on a device, by model of the warp,
// and what is saved by drawing only the wound's own region.
#pragma once
#include "stage/renderer.hpp"

namespace lab {

/// Two tables as Markdown, on stdout. Whatever is compared is measured in turn in one run; medians.
void measure_warp_cost(stage::Renderer& renderer, int rounds = 9);

} // namespace lab
