// The paper's frame rates (section 6.4) beside ours on this device.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "stage/measurement.hpp"

namespace figure_command {

/// A system of section 6.4, on a GTX 580.
struct PaperRate
{
    const char* system;
    double fps; // upper bound or middle of a range
    const char* words;
};
std::span<const PaperRate> paper_rates();

/// Of the interleaved cases: for each its medians of process_cpu_ms, wall_ms and frames per second; for each but
/// the first its cost over the first's with a 95 % interval, in processor time.
nlohmann::json frame_rates(const std::vector<stage::Measurement>& measurements);

} // namespace figure_command
