#include "wound/healing/timeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "wound/healing/phases.hpp"
#include "wound/healing/scar.hpp"
#include "wound/optics/skin_presets.hpp"

namespace wound {
namespace {

/// The phases of the open bed; each begins with its course in phase_at().
std::vector<TimelinePhase> open_phases(const Healing& healing, double closed, double last_day)
{
    if (healing.model == HealingModel::Contraction)
        return {{0, std::min(closed, last_day), "open"}};
    constexpr std::array names{"blood and clot", "inflammation", "granulation", "epithelialisation"};
    const PhaseDays begin = phase_days(std::min(closed, 1e6));
    const std::array first{0.0, begin.inflammation, begin.granulation, begin.epithelialisation};
    std::vector<TimelinePhase> phases;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double until = i + 1 < names.size() ? std::min(first[i + 1], closed) : closed;
        if (first[i] < std::min(closed, last_day))
            phases.push_back({first[i], std::min(until, last_day), names[i]});
    }
    return phases;
}

} // namespace

Timeline timeline(const Healing& healing, double last_day, int samples)
{
    CV_Assert(last_day > 0 && samples >= 2);
    Timeline result;
    result.closure_day = closure_day(healing.curve);
    result.phases = open_phases(healing, result.closure_day, last_day);
    if (result.closure_day <= last_day) {
        result.marks.push_back({result.closure_day, "closed"});
        result.phases.push_back({result.closure_day, last_day, "scar"});
        for (int months = 1; months <= 12; ++months)
            if (const double day = result.closure_day + months * optics::days_per_month; day <= last_day)
                result.marks.push_back(
                    {day, fmt::format("scar, {} {}", months, months == 1 ? "month" : "months")});
    }
    for (int i = 0; i < samples; ++i) {
        const double day = last_day * i / (samples - 1);
        result.open.emplace_back(day, unhealed_ratio(healing.curve, day));
    }
    return result;
}

} // namespace wound
