// `cicatrix warps --shader`: what the wound's two compute passes cost on a device, by rung of the warp, and
// what is saved by drawing only the wound's own region.
#pragma once
#include "apps/renderer.hpp"

namespace app {

/// Two tables as Markdown, on stdout. Whatever is compared is measured in turn in one run; medians.
void measure_warp_cost(Renderer& renderer, int rounds = 9);

} // namespace app
