// Measures the cost of the shading terms and of an unchanged frame, as ratios within one run.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/gpu/executor.hpp"
#include "stage/stage.hpp"

namespace stage {

/// Draws the variants alternately and compares the medians of `rounds` frames. Appends a summary for the user
/// to `lines`.
nlohmann::json measure_cost(const gpu::Device& device, const graph::ShaderLibrary& library,
                            const Stage& stage, std::vector<std::string>& lines, int rounds = 9);

} // namespace stage
