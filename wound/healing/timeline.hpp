// The course of a healing wound for a user interface: phases with names and days, the scar's months, and the
// healing curve as points.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "wound/healing/healing.hpp"

namespace wound {

/// The days of one phase. Real phases overlap; here each begins on the day on which it becomes visible.
struct TimelinePhase
{
    double first_day = 0, last_day = 0;
    const char* name = "";
};

struct TimelineMark
{
    double day = 0;
    std::string name; // "closed", "scar, 3 months"
};

struct Timeline
{
    double closure_day = 0;            // of the open bed; infinity for a wound that never closes
    std::vector<TimelinePhase> phases; // in order, without gaps; after closure the scar
    std::vector<TimelineMark> marks;   // up to the last day
    std::vector<cv::Point2d> open;     // x day, y area of the open bed / initial area (1 at day 0)
};

/// Days 0 to `last_day` (> 0), with the curve at `samples` (>= 2) equally spaced days. The phases are those
/// of phase_at(); a wound that closes by contraction alone, as in published mode, has the single phase
/// "open".
Timeline timeline(const Healing& healing, double last_day, int samples = 200);

} // namespace wound
