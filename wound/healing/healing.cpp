#include "wound/healing/healing.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "base/input_error.hpp"

namespace wound {

namespace {

void require(double value, double low, double high, std::string_view where, std::string_view field)
{
    if (!(value >= low && value <= high)) // also refuses NaN
        throw base::InputError(fmt::format("{}: {}", where, field), fmt::format("{} is out of range", value),
                               fmt::format("give a number from {} to {}", low, high));
}

} // namespace

H3 curve_through(double half_day, double closed_day)
{
    // exp(-delta t^gamma) = 1/2 and closed_ratio at the two days.
    H3 curve;
    curve.gamma = std::log(-std::log(closed_ratio) / std::log(2)) / std::log(closed_day / half_day);
    curve.delta = std::log(2) / std::pow(half_day, curve.gamma);
    return curve;
}

void validate(const Healing& healing, std::string_view where)
{
    require(healing.curve.delta, 0, 10, where, "healing.delta");
    require(healing.curve.gamma, .5, 4, where, "healing.gamma");
    require(healing.curve.theta, -1, 1, where, "healing.theta");
    require(healing.curve.asymptote, 0, .99, where, "healing.asymptote");
    require(healing.residual_border, 0, 1, where, "healing.residual_border");
    require(healing.age_days, 0, 1000, where, "healing.age_days");
}

double unhealed_ratio(const H3& curve, double day)
{
    const double t = std::max(day, 0.);
    if (t == 0)
        return 1;
    // delta = 0 with t^gamma = infinity would give NaN. One exponential of the sum, instead of a product with
    // the closed form of exp(-asinh), because a single factor could under- or overflow.
    const double power = curve.delta == 0 ? 0 : curve.delta * std::pow(t, curve.gamma);
    const double healing = std::exp(-(power + std::asinh(curve.theta * t)));
    return curve.asymptote + (1 - curve.asymptote) * healing;
}

HealingState healing_at(const Healing& healing, double day)
{
    HealingState state;
    state.day = day;
    state.unhealed_ratio = std::clamp(unhealed_ratio(healing.curve, day), 0., largest_drawn_ratio);
    const double r = state.unhealed_ratio;
    const double residual = healing.residual_border;
    // While the wound is larger than at first, border and bed are equal; there is no ring of new epithelium.
    const bool ring = healing.model == HealingModel::Face && r < 1;
    state.border_ratio = ring ? residual + (1 - residual) * r : r;
    state.recovery_ratio = std::clamp(1 - r, 0., 1.);
    state.depth_scale = std::sqrt(std::min(r, 1.));
    return state;
}

double day_below(const H3& curve, double level)
{
    constexpr double last_day = 1e9;
    if (!(unhealed_ratio(curve, last_day) < level))
        return std::numeric_limits<double>::infinity();
    // With theta < 0 the ratio may cross the level more than once (at most a fall, a rise and a fall), so
    // search for the last crossing backward in logarithmic steps, then bisect.
    double above = 0;
    double below = last_day;
    constexpr double step = 1.01;
    for (double day = last_day; day > 1e-9; day /= step) {
        if (unhealed_ratio(curve, day) >= level) {
            above = day;
            break;
        }
        below = day;
    }
    for (int i = 0; i < 100 && above < below; ++i) {
        const double middle = .5 * (above + below);
        (unhealed_ratio(curve, middle) >= level ? above : below) = middle;
    }
    return below;
}

} // namespace wound
