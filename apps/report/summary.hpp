// Statistics of a measurement per pass and per case, which `cicatrix report` prints, writes and draws.
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
    int ran = 0, skipped = 0, culled = 0; // numbers of frames
    std::string reason;                   // in the last frame, for example "changed: uniform Warp"
    std::optional<base::Spread> gpu_ms;   // over the frames in which it ran
    std::optional<base::Spread> cpu_ms;   // recording its commands, over the same frames
    double share = 0;                     // (GPU + recording time) / wall clock, mean over all frames
    double bytes_written = 0;             // median over the frames in which it ran
    double refreshed = 0; // share of its images' texels that it wrote, median over the frames in which it ran
    std::optional<gpu::Invocations> invocations; // medians over the counted frames
};

/// A part of a frame's wall clock. The shares of all parts of a case add up to 1.
struct FramePart
{
    std::string name;
    double share = 0; // mean over all frames
    base::Spread ms;
};

struct CaseSummary
{
    std::string name, what;
    base::Spread wall_ms;        // from declaring the frame to its end
    base::Spread process_cpu_ms; // CPU time of all threads of the process in that time
    std::optional<base::Spread> sum_ms,
        envelope_ms;                 // GPU: sum of the passes; time from the first start to the last end
    double coverage = 0;             // sum of the passes' shares
    std::vector<PassSummary> passes; // the most expensive first
    std::vector<FramePart> parts;    // in chronological order, as in part_names
    stage::FrameWork work;           // mean
    std::size_t median_frame = 0;    // index of the frame whose wall clock is nearest to the median
};

/// "32.1 frames/s, within 33.3 ms": what a frame of this wall clock is good for.
std::string rate_text(double wall_ms);

CaseSummary summarise(const stage::Measurement& measurement);

/// The table that the command prints.
std::string to_text(const CaseSummary& summary);

} // namespace report_command
