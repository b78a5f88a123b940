// The four cases of a report: nothing moves, the camera, the day, the tissue.
#pragma once
#include <vector>

#include "apps/measurement.hpp"
#include "apps/stage.hpp"

namespace app {

/// Still, camera and tissue show the scene's first day. Moving day goes from the first to the last, or over
/// ten days when there is but one. The stage must outlive the cases, and stands as it did after each frame.
std::vector<MeasuredCase> report_cases(Stage& stage);

/// How many triangles the frame's forward pass draws.
std::size_t triangles_drawn(const engine::Graph& graph);

} // namespace app
