// How an open wound's colour changes between injury and closure, beyond shrinking: bright blood, dark clot,
// yellow crust and fibrin, red granulation (wound-healing phases as in Singer & Clark 1999, "Cutaneous wound
// healing"). The colour of new skin comes from optics (skin_presets.hpp).
//
// A photograph shows one moment only. phase_at() says how much of the bed has changed since, and tinted()
// recolours a texel accordingly; a shader can do the same from the few numbers in Phase and bed_luminance().
#pragma once
#include <opencv2/core.hpp>

#include "wound/patch.hpp"

namespace wound {

/// Shares 0..1 of the bed that have turned since the photograph, applied in this order, and what is left of
/// the halo.
struct Phase
{
    double clot = 0;        // dark and dried, the darkest texels first
    double fibrin = 0;      // yellow slough or crust, the palest texels first
    double granulation = 0; // even red tissue, the reddest texels first
    double rim = 1;         // factor on the patch's opacity outside the mask: the inflamed halo fades
};

/// `day` since the photograph, which was taken `age_days` after the injury; the wound closes `closure_day`
/// after the photograph
/// (> 0). At day 0 nothing has turned: the photograph itself is shown. Continuous in time. The first five
/// days keep their pace (in quickly closing wounds they fill a fifth of the time), what follows stretches to
/// the day of closure.
Phase phase_at(double day, double closure_day, double age_days = 0);

/// When a wound that closes on `closure_day` (> 0) begins to show each phase. From day 0 it shows blood and
/// clot.
struct PhaseDays
{
    double inflammation = 0, granulation = 0, epithelialisation = 0;
};
PhaseDays phase_days(double closure_day);

/// Median luminance of the open bed: what dark and pale are measured against. 0 when the mask is empty.
double bed_luminance(const Patch& patch);

/// Linear colour of a bed texel at that phase.
cv::Vec3d tinted(const cv::Vec3d& color, const Phase& phase, double bed_luminance);

} // namespace wound
