// The course of a healing wound as a user interface shows it: phases with their names and days, months of the
// scar, and the healing curve as points.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "wound/healing/healing.hpp"

namespace wound {

/// A stretch of days. Phases overlap in life; a stretch begins where its phase starts to be seen.
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
    std::vector<TimelinePhase> phases; // in order, without gaps, until closure and then the scar's
    std::vector<TimelineMark> marks;   // up to the last day
    std::vector<cv::Point2d> open;     // x day, y area of the open bed / initial area (1 at day 0)
};

/// Days 0 to `last_day` (> 0); the curve is sampled at `samples` (>= 2) equal steps. The names are those of
/// the phases that phase_at() shows; a wound that closes by contraction alone, as in published mode, has the
/// one phase "open".
Timeline timeline(const Healing& healing, double last_day, int samples = 200);

} // namespace wound
