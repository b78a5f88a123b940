// Two commands that measure wound/ itself: `cicatrix warps` (the tables of docs/warp.md) and `cicatrix
// segmentation PHOTO MASK` (those of docs/wound.md).
#pragma once
#include <CLI/CLI.hpp>

namespace app {

void add_warps_command(CLI::App& program);
void add_segmentation_command(CLI::App& program);

} // namespace app
