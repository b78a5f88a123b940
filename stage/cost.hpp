// Measures the cost of the shading terms and of an unchanged frame, as ratios within one run.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/gpu/executor.hpp"
#include "stage/measurement.hpp"
#include "stage/stage.hpp"

namespace stage {

/// A case that draws the scene's camera and first day with `shading`; the day advances by `days` over the
/// measurement. The stage must outlive the case.
MeasuredCase shading_case(std::string name, const Stage& stage, const optics::Shading& shading,
                          double days = 0);

/// Draws the variants alternately and compares the medians of `rounds` frames. Appends a summary for the user
/// to `lines`.
nlohmann::json measure_cost(const gpu::Device& device, const graph::ShaderLibrary& library,
                            const Stage& stage, std::vector<std::string>& lines, int rounds = 9);

} // namespace stage
