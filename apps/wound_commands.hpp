// `cicatrix fit` and `cicatrix wound`: the science without a picture of a face; neither needs a Vulkan
// device.
#pragma once
#include <CLI/CLI.hpp>

namespace app {

/// Healing curves fitted to a table of measured areas.
void add_fit_command(CLI::App& program);
/// What was made of a photograph: mask, control points, warp, depth.
void add_wound_command(CLI::App& program);

} // namespace app
