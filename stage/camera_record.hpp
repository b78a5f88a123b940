// Writes a picture's camera as JSON for other programs. docs/capture.md defines the conventions.
#pragma once
#include <nlohmann/json.hpp>

#include "stage/stage.hpp"

namespace stage {

/// eye, target (metres, the head's coordinates), fov_deg (vertical), clip_from_world (of Vulkan: y down,
/// depth 0 to 1), camera_from_world (x right, y down, z forward, metres) and intrinsics fx, fy, cx, cy in
/// pixels (the top left pixel's centre is at 0.5, 0.5). Matrices are arrays of four rows that act on columns.
nlohmann::json camera_record(const Stage& stage, const head::Camera& camera,
                             std::array<std::uint32_t, 2> size);

} // namespace stage
