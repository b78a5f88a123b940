// One thin-plate spline step of the contraction: the linear system used by wound/warp/warp.hpp.
#pragma once
#include <vector>

#include "wound/warp/warp.hpp"

namespace wound {

/// The backward step that maps each control point from its position at scale `from` to that at scale `to`
/// about the centroid, and fixes anchors on the patch's frame. Throws std::runtime_error if the system is
/// singular in double precision.
ThinPlate contraction_step(const std::vector<cv::Point2d>& control_points, cv::Point2d centroid, double from,
                           double to);

/// Applies the step to many points, in single precision (error .001 texel of 512). Used to fill grids.
void apply_in_place(const ThinPlate& step, std::vector<float>& x, std::vector<float>& y);

} // namespace wound
