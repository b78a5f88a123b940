// `cicatrix-lab warps --shader`: cost of the wound's two compute passes on a device by warp model, and the
// saving when only the wound's region is drawn.
#pragma once
#include "stage/renderer.hpp"

namespace lab {

/// Prints two Markdown tables of medians. The compared variants are measured alternately in one run.
void measure_warp_cost(stage::Renderer& renderer, int rounds = 9);

} // namespace lab
