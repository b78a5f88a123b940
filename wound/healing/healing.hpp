// The size of a wound on a given day: the hyperbolic model H3, and closure by contraction or epithelium.
//
//   Tabatabai, Williams, Bursac 2005; Tabatabai, Eby, Singh 2011, "Hyperbolic modeling of wound healing":
//   dP/dt = (M - P)(delta gamma t^(gamma-1) + theta / sqrt(1 + theta^2 t^2)), with P(0) = 1 the size ratio r
//   below.
//
// r > 1 is allowed: a wound that first grows (retraction, oedema). HealingState clamps it to
// largest_drawn_ratio.
#pragma once
#include <string_view>

namespace wound {

/// r(t) = m + (1 - m) exp(-delta t^gamma - asinh(theta t)). The defaults are an untreated human facial wound:
/// half closed after 8.45 days (Yang et al. 2016, PLoS ONE 11(9):e0163092), 1 % open on day 30.
struct H3
{
    double delta = .02822; // day^-gamma, 0..10
    double gamma = 1.5;    // 0.5..4
    double theta = 0;      // day^-1, -1..1
    double asymptote = 0;  // m, the ratio that never heals, 0 <= m < 1
    bool operator==(const H3&) const = default;
};

/// The H3 with theta 0 that is half closed on `half_day` and down to closed_ratio on `closed_day`.
/// 0 < half_day; 1.61 half_day <= closed_day <= 44 half_day.
H3 curve_through(double half_day, double closed_day);

enum class HealingModel
{
    Contraction, // the border itself closes, as in the paper and in mice
    Face // as in people: the border shrinks to a residual, new epithelium closes the open bed inside it
};

struct Healing
{
    H3 curve; // of the open bed's area
    HealingModel model = HealingModel::Face;
    double residual_border = .43; // area inside the border at closure / initial area; Face only. Contraction
                                  // closes at least 57 % of a facial wound
    double age_days = 0; // 0..1000: of the wound on day 0; the phases of these days are over. Face only
    bool operator==(const Healing&) const = default;
};

/// One day. r is the UNhealed ratio of eq. (1), 1 -> 0; recovery is the r of eq. (4), 0 -> 1.
struct HealingState
{
    double day = 0;
    double unhealed_ratio = 1; // area of the open bed / initial area, 0..largest_drawn_ratio
    double border_ratio =
        1; // area inside the outer border / initial area; equals unhealed_ratio for contraction
    double recovery_ratio = 0; // 1 - unhealed_ratio, clamped to 0..1
    double depth_scale = 1;    // sqrt(unhealed_ratio), at most 1
};

inline constexpr double largest_drawn_ratio = 1.4; // larger ratios are clamped to this
inline constexpr double closed_ratio = .01;        // a wound with a smaller ratio counts as closed

/// Throws base::InputError naming the field, for instance "scene.json: healing.gamma", if a value is out of
/// range.
void validate(const Healing& healing, std::string_view where);

/// Negative days count as 0. For curves that pass validate(): relative error at most 1e-12 down to the
/// smallest normal double, and never NaN for a finite day.
double unhealed_ratio(const H3& curve, double day);

HealingState healing_at(const Healing& healing, double day);

/// The day after which the ratio stays below `level` (0..1); infinity if there is none.
double day_below(const H3& curve, double level);
inline double half_time(const H3& curve)
{
    return day_below(curve, .5);
}
inline double closure_day(const H3& curve)
{
    return day_below(curve, closed_ratio);
}

} // namespace wound
