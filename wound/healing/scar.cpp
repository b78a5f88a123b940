#include "wound/healing/scar.hpp"

#include <algorithm>
#include <cmath>

#include "wound/optics/skin_presets.hpp"

namespace wound {

namespace {

constexpr double highest_mm = .25; // at highest_month
constexpr double highest_month = 2.5;
constexpr double sunken_mm = .06; // final depth below the skin

} // namespace

ScarState scar_after(double months)
{
    const double t = std::max(months, 0.);
    ScarState scar;
    scar.months = t;
    scar.redness = 2.055 / (1 + t / 2.37);
    // New epithelium has no excess of melanin; the excess builds up in one to two weeks and fades over
    // months.
    scar.pigmentation = .306 * std::exp(-t / 4.3) * (1 - std::exp(-t / .25));
    scar.height_mm =
        highest_mm * t / highest_month * std::exp(1 - t / highest_month) - sunken_mm * (1 - std::exp(-t / 6));
    scar.sheen = .35 + .65 * std::exp(-t / 5);
    scar.pore_loss = .8 + .2 * std::exp(-t / 6);
    return scar;
}

ScarState scar_at(const Healing& healing, double day)
{
    const double closed = closure_day(healing.curve);
    return scar_after(std::isfinite(closed) ? (day - closed) / optics::days_per_month : 0);
}

} // namespace wound
