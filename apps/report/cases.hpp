// The four cases of a report: nothing moves, the camera, the day, the tissue.
#pragma once
#include <vector>

#include "stage/measurement.hpp"
#include "stage/stage.hpp"

namespace report_command {

/// Still, camera and tissue show the scene's first day. Moving day goes from the first to the last, or over
/// ten days when there is but one. The stage must outlive the cases, and stands as it did after each frame.
std::vector<stage::MeasuredCase> report_cases(stage::Stage& stage);

/// How many triangles the frame's forward pass draws.
std::size_t triangles_drawn(const graph::Graph& graph);

} // namespace report_command
