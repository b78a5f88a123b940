// Finds skin, and healthy skin, around a wound in its photograph, on a coarse grid.
#pragma once
#include <opencv2/core.hpp>

#include "base/color.hpp"

namespace wound {

/// Healthy skin assumed for a photograph that shows none: the mean of the four groups' cheeks in Xiao et al.
/// 2017.
inline constexpr base::Lab average_skin{59.3, 11.4, 15.5};
/// The smallest share of a patch from which the healthy skin's colour is estimated.
inline constexpr double least_skin = .0025;

/// All maps are square grids of `healthy_skin_grid` cells over the patch.
inline constexpr int healthy_skin_grid = 128;

struct HealthySkin
{
    bool found = false;  // whether there was enough skin around the wound to estimate `log_color`
    cv::Vec3f log_color; // natural logarithms of the healthy skin's linear rgb
    /// 0 in the wound and at its border .. 1 at the end of the usable surroundings: at anything that is not
    /// skin, at the patch's frame, and at most `reach` from the border.
    cv::Mat1f outwardness;
    cv::Mat1f health;      // 0..1: whether the cell shows healthy skin outside the wound
    cv::Mat1f foreignness; // outside the wound: 0..1, 1 on crust, slough or dead skin near the border, which
                           // must not be matched to skin
    cv::Mat1f
        rawness; // inside the wound: 0..1, 0 where the mask contains healthy-looking skin near its border
};

/// `log_color`: logarithms of the photo's linear rgb; `coverage`: of the wound, 0..1; `valid`: 0..1, 1 where
/// the photo has data; `reach`: in cells.
HealthySkin find_healthy_skin(const cv::Mat3f& log_color, const cv::Mat1f& coverage, const cv::Mat1f& valid,
                              float reach);

/// Absorbance per channel of one unit of extra blood: inflamed skin differs from healthy skin in log_color by
/// a multiple of it.
inline const cv::Vec3f blood_absorbance{.16f, 1.f, .90f};

} // namespace wound
