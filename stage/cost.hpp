// What the shading terms and an unchanged frame cost, as ratios measured in one run.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/gpu/executor.hpp"
#include "stage/stage.hpp"

namespace stage {

/// Measures the variants in turn and compares medians of `rounds` frames. `lines` receives what a person
/// reads.
nlohmann::json measure_cost(const gpu::Device& device, const graph::ShaderLibrary& library,
                            const Stage& stage, std::vector<std::string>& lines, int rounds = 9);

} // namespace stage
