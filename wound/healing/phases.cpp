#include "wound/healing/phases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/color.hpp"
#include "base/smoothstep.hpp"

namespace wound {
namespace {

using cv::Vec3d;

struct Knot
{
    double day, value;
};

/// Piecewise linear through the knots, constant beyond them.
template <std::size_t count>
double along(const std::array<Knot, count>& knots, double day)
{
    if (day <= knots.front().day)
        return knots.front().value;
    for (std::size_t i = 1; i < count; ++i)
        if (day < knots[i].day)
            return std::lerp(knots[i - 1].value, knots[i].value,
                             (day - knots[i - 1].day) / (knots[i].day - knots[i - 1].day));
    return knots.back().value;
}

// Courses in days of a wound that closes on day 25.
constexpr double early_days = 5, closing_days = 25;
constexpr std::array<Knot, 5> clot_course{{{0, 0}, {1.5, .42}, {3, .34}, {6, .06}, {9, 0}}};
constexpr std::array<Knot, 5> fibrin_course{{{.8, 0}, {3, .36}, {4.5, .36}, {8, .05}, {12, 0}}};
constexpr std::array<Knot, 4> granulation_course{{{2.5, 0}, {5, .45}, {8, .85}, {11, 1}}};
constexpr std::array<Knot, 4> rim_course{{{0, 1}, {3, 1}, {12, .55}, {25, .15}}};

const Vec3d clot_color{.085, .014, .011}, fibrin_color{.54, .39, .20}, granulation_color{.37, .045, .042};

/// 0..1: how far a texel has changed when `share` of the bed has; texels of `rank` 1 change first, of 0 last.
double changed(double share, double rank)
{
    return base::smoothstep(1 - 1.5 * share, 1.5 - 1.5 * share, rank);
}

Vec3d mix(const Vec3d& a, const Vec3d& b, double t)
{
    return a + (b - a) * t;
}

} // namespace

Phase phase_at(double day, double closure_day, double age_days)
{
    const double early = std::min(early_days, closure_day * early_days / closing_days);
    const auto healing_time = [&](double since) {
        return since < early ? since * early_days / early
                             : early_days + (since - early) * (closing_days - early_days) /
                                                (closure_day + age_days - early);
    };
    const double then = healing_time(std::max(age_days, 0.)),
                 now = healing_time(std::max(day, 0.) + std::max(age_days, 0.));
    // The photograph already shows the change up to the day on which it was taken.
    const auto since_photo = [&](const auto& course) {
        return std::max(along(course, now) - along(course, then), 0.);
    };
    // All of a photographed slough granulates in the end, but a bed that had granulated by then changes
    // little.
    constexpr double least_left = .25;
    const double left = std::max(1 - along(granulation_course, then), least_left);
    return {since_photo(clot_course), since_photo(fibrin_course), since_photo(granulation_course) / left,
            along(rim_course, now) / along(rim_course, then)};
}

PhaseDays phase_days(double closure_day)
{
    const double early = std::min(early_days, closure_day * early_days / closing_days);
    const auto day_of = [&](double healing_time) { // inverse of healing_time() in phase_at()
        return healing_time < early_days ? healing_time * early / early_days
                                         : early + (healing_time - early_days) * (closure_day - early) /
                                                       (closing_days - early_days);
    };
    return {day_of(fibrin_course.front().day), day_of(granulation_course.front().day),
            day_of(early_days)}; // new epithelium grows from the end of inflammation
}

double bed_luminance(const Patch& patch)
{
    std::vector<float> values;
    for (int y = 0; y < patch.mask.rows; ++y)
        for (int x = 0; x < patch.mask.cols; ++x)
            if (patch.mask(y, x) > .5f)
                values.push_back(base::luminance(patch.color(y, x)));
    if (values.empty())
        return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

cv::Vec3d tinted(const cv::Vec3d& color, const cv::Vec3d& around, const Phase& phase, double bed_luminance)
{
    const auto light_of = [&](const cv::Vec3d& c) { // relative to the bed's median
        return std::max(double(base::luminance(c)), 1e-4) / std::max(bed_luminance, 1e-4);
    };
    // 0..1 for 1/4 .. 4 times the median.
    const double paleness = std::clamp(.5 + .25 * std::log2(light_of(around)), 0., 1.);
    const double redness = std::clamp(1 - 2 * around[1] / std::max(around[0], 1e-4), 0., 1.);
    // Keeps the photograph's texture visible.
    const double relief = std::sqrt(std::clamp(light_of(color), .35, 1.8));
    Vec3d result = mix(color, clot_color * relief, .8 * changed(phase.clot, 1 - paleness));
    // Clean red beds stay so.
    result = mix(result, fibrin_color * relief, .65 * changed(phase.fibrin, paleness * (1 - .5 * redness)));
    return mix(result, granulation_color * relief, .72 * changed(phase.granulation, redness));
}

} // namespace wound
