// What new skin over a wound looks like, relative to the skin beside it: from the first new epithelium over
// closure to the old scar. The paper's own future work. It covers what is inside the wound's border and
// outside its open bed, so it needs no switch at closure.
#pragma once
#include "wound/healing/healing.hpp"

namespace wound {

struct ScarState
{
    double months = 0;       // since closure; 0 before it
    double redness = 0;      // relative excess of erythema over the skin beside it; 0 is equal
    double pigmentation = 0; // relative excess of melanin
    double height_mm = 0;    // raised while it matures, slightly sunken when old
    double sheen = 0;        // 1 as smooth and shiny as new epithelium .. 0 as skin
    double pore_loss = 0;    // 1 no pores or fine lines .. 0 as skin
};

/// At months since closure, >= 0; negative counts as 0. Redness: 2.055 / (1 + t / 2.37), within .022 of +145,
/// +89 and +36 % at 1, 3 and 12 months; pigmentation within .02 of +24, +15 and 0 % (Danielsen et al. 2013,
/// Acta Derm. Venereol. 93(3), donor sites on the thigh). Height, sheen and pores follow the clinical course
/// (raised for some months, flat, shiny for good) with amplitudes of our choice.
ScarState scar_after(double months);

/// On a day of a healing wound. Before closure the new epithelium has the look of a scar of age 0.
ScarState scar_at(const Healing& healing, double day);

} // namespace wound
