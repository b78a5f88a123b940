// Which part of a wound's photograph is skin, and which of it healthy: judged on a coarse grid around the
// wound.
#pragma once
#include <opencv2/core.hpp>

#include "base/color.hpp"

namespace wound {

/// What is taken for healthy skin where a photograph shows none: the mean of the four groups' cheeks in Xiao
/// et al. 2017.
inline constexpr base::Lab average_skin{59.3, 11.4, 15.5};
/// The smallest share of a patch that can be taken for its healthy skin.
inline constexpr double least_skin = .0025;

/// All maps are square grids of `healthy_skin_grid` cells over the patch.
inline constexpr int healthy_skin_grid = 128;

struct HealthySkin
{
    bool found = false;  // enough skin around the wound to speak of a skin colour
    cv::Vec3f log_color; // natural logarithms of the healthy skin's linear rgb
    /// 0 at the wound's border and inside .. 1 where the usable surroundings end: at the edge of the skin, at
    /// the patch's frame, at anything that is not skin, and `reach` from the border at the latest.
    cv::Mat1f outwardness;
    cv::Mat1f health;      // 0..1: whether the cell shows healthy skin outside the wound
    cv::Mat1f foreignness; // 0..1, outside: crust, slough or dead skin near the border, which is no skin to
                           // be matched
    cv::Mat1f
        rawness; // inside: 0 where the mask took in what looks like healthy skin near the border, otherwise 1
};

/// `log_color`: logarithms of the photo's linear rgb; `coverage`: the wound's, 0..1; `valid`: 0..1, where the
/// photo has data. `reach` in cells.
HealthySkin find_healthy_skin(const cv::Mat3f& log_color, const cv::Mat1f& coverage, const cv::Mat1f& valid,
                              float reach);

/// Absorbance of a little more blood per channel, by which inflamed skin differs from healthy skin in
/// log_color.
inline const cv::Vec3f blood_absorbance{.16f, 1.f, .90f};

} // namespace wound
