// What a measurement comes to: per pass and per case the numbers that `cicatrix report` prints, writes and
// draws.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/statistics.hpp"
#include "stage/measurement.hpp"

namespace report_command {

struct PassSummary
{
    std::string name;
    int ran = 0, skipped = 0, culled = 0; // frames
    std::string reason;                   // of the last frame: "changed: uniform Warp"
    std::optional<base::Spread> gpu_ms;   // of the frames in which it ran
    std::optional<base::Spread> cpu_ms;   // the same: recording its commands
    double share = 0;         // of a frame's wall clock, GPU and recording together, mean over all frames
    double bytes_written = 0; // median of the frames in which it ran
    std::optional<gpu::Invocations> invocations; // the same, of the counted frames
};

/// A part of a frame's wall clock. All parts of a case make up the whole.
struct FramePart
{
    std::string name;
    double share = 0; // mean over all frames
    base::Spread ms;
};

struct CaseSummary
{
    std::string name, what;
    base::Spread wall_ms; // from declaring the frame to its picture on the host
    std::optional<base::Spread> sum_ms,
        envelope_ms;                 // on the GPU: of the passes; from the first's begin to the last's end
    double coverage = 0;             // share of the wall clock that the passes explain, GPU and recording
    std::vector<PassSummary> passes; // the dearest first
    std::vector<FramePart> parts;    // in the order of a frame
    std::size_t median_frame = 0;    // index of the frame whose wall clock is nearest to the median
};

CaseSummary summarise(const stage::Measurement& measurement);

/// The table that the command prints, the dearest pass first.
std::string to_text(const CaseSummary& summary);

} // namespace report_command
