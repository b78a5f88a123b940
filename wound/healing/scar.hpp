// Appearance of new skin over a wound relative to the adjacent skin, from the first new epithelium to the old
// scar; the paper names this as future work. It applies inside the wound's border and outside the open bed,
// so nothing switches at closure.
#pragma once
#include "wound/healing/healing.hpp"

namespace wound {

struct ScarState
{
    double months = 0;       // since closure; 0 before it
    double redness = 0;      // relative excess of erythema over the skin beside it; 0 is equal
    double pigmentation = 0; // relative excess of melanin
    double height_mm = 0;    // raised while it matures, slightly sunken when old
    double sheen = 0;        // 0 as skin .. 1 as smooth and shiny as new epithelium
    double pore_loss = 0;    // 0 as skin .. 1 no pores or fine lines
};

/// `months` since closure; negative counts as 0. Redness: 2.055 / (1 + t / 2.37), within .022 of +145, +89
/// and +36 % at 1, 3 and 12 months; pigmentation within .02 of +24, +15 and 0 % (Danielsen et al. 2013, Acta
/// Derm. Venereol. 93(3), donor sites on the thigh). Height, sheen and pores follow the clinical course
/// (raised for some months, then flat, permanently shiny); their amplitudes are chosen by eye.
ScarState scar_after(double months);

/// The scar on a day of a healing wound. Before closure new epithelium looks like a scar of age 0.
ScarState scar_at(const Healing& healing, double day);

} // namespace wound
