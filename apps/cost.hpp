// What the shading terms and an unchanged frame cost, as ratios measured in one run.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/stage.hpp"
#include "engine/executor.hpp"

namespace app {

/// Of at least one value.
double median(std::vector<double> values);

/// Draws the variants in turn, `rounds` times after a warm-up, and compares medians. `lines` receives what a
/// person reads.
nlohmann::json measure_cost(engine::Executor& executor, const Stage& stage, std::vector<std::string>& lines,
                            int rounds = 9);

} // namespace app
