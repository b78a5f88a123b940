// The four cases of a report: nothing changes, or the camera, the day or the tissue changes.
#pragma once
#include <vector>

#include "stage/measurement.hpp"
#include "stage/stage.hpp"

namespace report_command {

/// Still frame and moving camera show the scene's first day. Moving day goes from the first to the last, or
/// over ten days when there is only one; moving tissue shows a day at a third of that span. The stage must
/// outlive the cases; each frame leaves it unchanged.
std::vector<stage::MeasuredCase> report_cases(stage::Stage& stage);

/// Number of triangles that the frame's forward pass draws.
std::size_t triangles_drawn(const graph::Graph& graph);

} // namespace report_command
