// How an open wound's colour changes between injury and closure: bright blood, dark clot, yellow crust and
// fibrin, red granulation (wound-healing phases as in Singer & Clark 1999, "Cutaneous wound healing"). The
// colour of new skin comes from wound/optics/skin_presets.hpp.
//
// A photograph shows one moment only. phase_at() gives the share of the bed that has changed since, and
// tinted() recolours a texel accordingly; a shader needs only Phase and bed_luminance() to do the same.
#pragma once
#include <opencv2/core.hpp>

#include "wound/patch.hpp"

namespace wound {

/// Shares 0..1 of the bed that have changed since the photograph, applied in this order, and the halo's
/// opacity.
struct Phase
{
    double clot = 0;        // dark and dried, the darkest texels first
    double fibrin = 0;      // yellow slough, the palest texels that are not red first
    double granulation = 0; // even red tissue, the reddest texels first
    double rim = 1;         // factor on the patch's opacity outside the mask: the inflamed halo fades
};

/// `day` and `closure_day` (> 0) count from the photograph, which was taken `age_days` after the injury. On
/// day 0 nothing has changed: the photograph itself is shown. Continuous in time. The first five days have a
/// fixed pace (or take a fifth of closure_day, if that is shorter); later phases are stretched to the
/// closure.
Phase phase_at(double day, double closure_day, double age_days = 0);

/// First day of each phase in a wound that closes on `closure_day` (> 0). Blood and clot show from day 0.
struct PhaseDays
{
    double inflammation = 0, granulation = 0, epithelialisation = 0;
};
PhaseDays phase_days(double closure_day);

/// Median luminance of the open bed, the reference for dark and pale texels. 0 if the mask is empty.
double bed_luminance(const Patch& patch);

/// Linear colour of a bed texel at that phase. `around`: the bed's mean colour near the texel, which decides
/// what it turns into, so that patches have soft edges.
cv::Vec3d tinted(const cv::Vec3d& color, const cv::Vec3d& around, const Phase& phase, double bed_luminance);

} // namespace wound
