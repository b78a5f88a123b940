// One thin-plate spline step of the contraction: the linear system behind wound/warp.hpp.
#pragma once
#include <vector>

#include "wound/warp/warp.hpp"

namespace wound {

/// The backward step that maps each control point's place at scale `from` to its place at scale `to` about
/// the centroid, and keeps anchors on the patch's frame. Throws std::runtime_error when the system is
/// singular to double precision.
ThinPlate contraction_step(const std::vector<cv::Point2d>& control_points, cv::Point2d centroid, double from,
                           double to);

/// Moves many points by the step at once, in single precision (a thousandth of a texel of 512): what grids
/// are filled with.
void apply_in_place(const ThinPlate& step, std::vector<float>& x, std::vector<float>& y);

} // namespace wound
