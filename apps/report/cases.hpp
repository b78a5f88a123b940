// The cases of a report: nothing changes, or the camera, the day, a light or the tissue changes.
#pragma once
#include <string>
#include <vector>

#include "stage/measurement.hpp"
#include "stage/stage.hpp"

namespace report_command {

const std::vector<std::string>& case_names();

/// The cases of case_names() among those names; all of them when there is no name. Where the day stands it is
/// the scene's first; where it goes on, it goes to the last, or over ten days when there is only one; the
/// tissue changes on a day at a third of that span. Frames are drawn as a window draws them: nothing runs
/// when nothing has changed, and only `read-back` copies the picture to the host. The stage must outlive the
/// cases; each frame leaves it unchanged.
std::vector<stage::MeasuredCase> report_cases(stage::Stage& stage, const std::vector<std::string>& chosen);

/// "one-wound" and "many-wounds": the turning camera of the scene with one wound of 30 mm, and with 64 wounds
/// of 6 mm all over the face, light kept on the skin. Those of `chosen`, measured only when named. Throws
/// base::InputError when a wound does not find the head.
const std::vector<std::string>& wound_case_names();
std::vector<stage::MeasuredCase> wound_cases(const gpu::Device& device, const scene::Scene& scene,
                                             const std::vector<std::string>& chosen);

/// Number of triangles that the frame's forward pass draws.
std::size_t triangles_drawn(const graph::Graph& graph);

} // namespace report_command
